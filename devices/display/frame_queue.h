#pragma once

#include <deque>
#include <mutex>

#include "devices/display/display.h"

namespace focalstage {

/// What displays of every kind have in common: the frames that wait for their vblank, and the count of what was shown.
/// Locks are held for moments only.
class FrameQueue {
 public:
  explicit FrameQueue(std::size_t most) : most_(most) {}

  /// Empties and begins to count; `pixels` of each frame.
  void open(std::size_t pixels);
  void close();

  Status post(VideoFrame frame);
  std::size_t waiting() const;
  void forget() noexcept;

  /// The frame of the next vblank: black where none waits.
  VideoFrame take();
  /// What was taken last is shown now, after `repeated` vblanks that showed what the one before did.
  void shown(double vblank_s, std::uint64_t repeated);
  /// Nothing is shown any more.
  void lose(Fault fault);

  DisplayReport report() const;

 private:
  mutable std::mutex mutex_;
  std::size_t most_;
  std::size_t pixels_ = 0;
  bool open_ = false;
  enum class Taken { nothing, black, frame } taken_ = Taken::nothing;  ///< last
  std::deque<VideoFrame> frames_;
  DisplayReport report_;
};

}  // namespace focalstage
