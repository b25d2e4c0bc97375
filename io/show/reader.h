#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

#include "core/base/result.h"
#include "core/compile/frame.h"
#include "io/show/show.h"

namespace focalstage {

/// Reads a show, checked whole: names, types, shapes, ranges, hashes. Never crashes, whatever the bytes.
class ShowReader {
 public:
  /// Faults "show.*" name the file and the dataset. The file stays open: frames are read from it.
  static Result<ShowReader> open(const std::filesystem::path& path);

  ShowReader(ShowReader&&) noexcept;
  ShowReader& operator=(ShowReader&&) noexcept;
  ~ShowReader();

  const ShowHeader& header() const;

  /// All images of one frame, or one of them.
  Result<FrameImages> frame(int frame) const;
  Result<FrameImages> image(int frame, int image) const;

 private:
  struct State;
  explicit ShowReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
