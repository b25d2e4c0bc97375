#pragma once

#include <memory>
#include <string>

#include "core/base/result.h"

namespace focalstage::bench {

/// An OpenGL 3.3 core context without any window, on Mesa's software rasteriser; current on the thread that made it.
class GlContext {
 public:
  static Result<std::shared_ptr<GlContext>> make();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  std::string renderer() const;

 private:
  GlContext() = default;
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace focalstage::bench
