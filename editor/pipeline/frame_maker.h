#pragma once

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/base/result.h"
#include "core/compile/compile.h"
#include "core/compile/coverage.h"
#include "core/stage/stage.h"
#include "editor/pipeline/image_pool.h"

namespace focalstage {

/// Told after each frame: how many are done, of how many.
using FrameProgress = std::function<void(int done, int of)>;

/// How to compile: what does not change the images.
struct EngineChoice {
  int threads = 0;  ///< 0: all
  bool reference = false;
  VectorPath vectors = VectorPath::best;
};

/// Makes frame after frame of a project: stands it up, measures what of it can be served, compiles it. Where nothing
/// moved since the frame before, that one's results are given again.
class FrameMaker {
 public:
  /// Both stay as they are while it works.
  FrameMaker(const Project& project, const Assets& assets, EngineChoice choice);
  FrameMaker(const FrameMaker&) = delete;  // a measurement under way works with this one
  FrameMaker& operator=(const FrameMaker&) = delete;

  const Project& project() const { return project_; }
  std::size_t projectors() const { return settings_.size(); }
  const CompileSettings& settings(std::size_t projector = 0) const { return settings_[projector]; }

  /// Stands up frame `frame` of the project; the other calls are about it.
  Status stand_up(int frame);

  const Stage& staged() const { return *stage_; }

  /// Measured beside whoever compiles the frame, unless one thread must do.
  const std::vector<ObjectCoverage>& coverage();

  struct Made {
    std::shared_ptr<const FrameImages> images;
    FrameMeasure measure;
  };
  /// What one of the projectors shows.
  Result<Made> compile(std::stop_token stop, std::size_t projector = 0);

 private:
  const Project& project_;
  const Assets& assets_;
  EngineChoice choice_;
  std::vector<CompileSettings> settings_;  ///< of each projector
  std::vector<Compiler> compilers_;
  CoverageMeter meter_;
  ImagePool pool_;
  std::optional<Stage> stage_;
  std::vector<std::optional<Made>> made_;
  std::shared_future<std::vector<ObjectCoverage>> coverage_;  ///< last: it works with all that stands above
};

}  // namespace focalstage
