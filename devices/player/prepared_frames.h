#pragma once

#include <memory>
#include <utility>

#include "core/base/result.h"
#include "core/compile/frame.h"

namespace focalstage {

/// The frames of a show as the player asks for them, wherever they come from: read ahead from a file (FrameCache), or
/// one that is in memory whole (OneFrame).
class PreparedFrames {
 public:
  using Frame = std::shared_ptr<const FrameImages>;

  PreparedFrames() = default;
  PreparedFrames(const PreparedFrames&) = delete;
  PreparedFrames& operator=(const PreparedFrames&) = delete;
  virtual ~PreparedFrames() = default;

  /// The frame if it is there, null if it is not yet; from now on it and those after it are prepared. A fault where it
  /// can't be had.
  virtual Result<Frame> get(int frame) = 0;

  /// The same, but waits until it is there.
  virtual Result<Frame> wait_for(int frame) = 0;

  /// True once `frame`, to which play is about to jump, need not be waited for: it is there, or can't be had. What
  /// plays now is kept as before.
  virtual bool prepare(int frame) = 0;
};

/// A single frame, there from the start.
class OneFrame final : public PreparedFrames {
 public:
  explicit OneFrame(Frame frame) : frame_(std::move(frame)) {}

  Result<Frame> get(int) override { return frame_; }
  Result<Frame> wait_for(int) override { return frame_; }
  bool prepare(int) override { return true; }

 private:
  Frame frame_;
};

}  // namespace focalstage
