#pragma once

#include <memory>
#include <stop_token>

#include "core/base/result.h"
#include "core/compile/frame.h"
#include "core/stage/stage.h"

namespace focalstage {

/// Which instructions the engine runs on; the bytes are the same.
enum class VectorPath { best, portable };

/// Compiles frame after frame of one project. Keeps between frames only what did not change (where the projector's
/// rays meet surfaces that stand still). One frame at a time; each uses up to `threads` threads (0: all).
class Compiler {
 public:
  explicit Compiler(CompileSettings settings, int threads = 0, VectorPath path = VectorPath::best);
  ~Compiler();
  Compiler(Compiler&&) noexcept;
  Compiler& operator=(Compiler&&) noexcept;

  /// The images of `stage`. Fault: "compile.cancelled" within milliseconds of a stop request. `recycled` gives back the
  /// memory of an earlier frame. `clips`: filled with where its light cannot be reached.
  Result<CompiledFrame> frame(const Stage& stage, std::stop_token stop = {}, FrameImages recycled = {},
                              ClipMap* clips = nullptr);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
