#include "devices/display/frame_queue.h"

#include <utility>

namespace focalstage {

void FrameQueue::open(std::size_t pixels) {
  const std::lock_guard lock(mutex_);
  pixels_ = pixels;
  open_ = true;
  frames_.clear();
  report_ = {};
}

void FrameQueue::close() {
  const std::lock_guard lock(mutex_);
  open_ = false;
  frames_.clear();
}

Status FrameQueue::post(VideoFrame frame) {
  const std::lock_guard lock(mutex_);
  if (report_.fault || !open_) {
    return Fault{"display.lost", "display", "frames are posted to an output that shows nothing", "open it again"};
  }
  if (frame && frame->size() != pixels_) {
    return Fault{"display.size", "display",
                 "a frame of " + std::to_string(frame->size()) + " pixels for an output of " + std::to_string(pixels_),
                 "post frames of the mode's size"};
  }
  if (frames_.size() >= most_) {
    return Fault{"display.full", "display", std::to_string(most_) + " frames are waiting", "post when one is shown"};
  }
  frames_.push_back(std::move(frame));
  return {};
}

std::size_t FrameQueue::waiting() const {
  const std::lock_guard lock(mutex_);
  return frames_.size();
}

void FrameQueue::forget() noexcept {
  const std::lock_guard lock(mutex_);
  frames_.clear();
}

VideoFrame FrameQueue::take() {
  const std::lock_guard lock(mutex_);
  if (frames_.empty()) {
    taken_ = Taken::nothing;
    return nullptr;
  }
  VideoFrame frame = std::move(frames_.front());
  frames_.pop_front();
  taken_ = frame ? Taken::frame : Taken::black;
  return frame;
}

void FrameQueue::shown(double vblank_s, std::uint64_t repeated) {
  const std::lock_guard lock(mutex_);
  report_.vblanks += 1 + repeated;
  report_.repeated += repeated;
  ++(taken_ == Taken::frame ? report_.shown : taken_ == Taken::black ? report_.dark : report_.silent);
  report_.newest_vblank_s = vblank_s;
}

void FrameQueue::lose(Fault fault) {
  const std::lock_guard lock(mutex_);
  frames_.clear();
  report_.fault = std::move(fault);
}

DisplayReport FrameQueue::report() const {
  const std::lock_guard lock(mutex_);
  return report_;
}

}  // namespace focalstage
