#pragma once

#include <atomic>

#include "devices/display/display.h"
#include "devices/display/frame_queue.h"
#include "tests/devices/lightcrafter/emulator/board.h"

namespace focalstage {

/// A video cable to the emulated board whose vblanks come when a test says so.
class BoardDisplay final : public Display {
 public:
  explicit BoardDisplay(lightcrafter_emulator::Board& board, VideoMode mode = {912, 1140, 1.0 / 60.0})
      : board_(board), mode_(mode), queue_(2) {}

  Status open() override {
    if (!opens) return Fault{"display.absent", "display", "no such display is connected", "connect it"};
    queue_.open(static_cast<std::size_t>(mode_.width_px) * static_cast<std::size_t>(mode_.height_px));
    return {};
  }
  void close() override { queue_.close(); }
  VideoMode mode() const override { return mode_; }
  Status post(VideoFrame frame) override { return queue_.post(std::move(frame)); }
  std::size_t waiting() const override { return queue_.waiting(); }
  void black() noexcept override { queue_.forget(); }
  DisplayReport report() const override { return queue_.report(); }

  void vblank() {
    const double now_s = vblanks_++ * mode_.interval_s;
    const VideoFrame frame = queue_.take();
    board_.video_frame(frame ? *frame : black_, now_s);
    queue_.shown(now_s, 0);
  }
  void unplug() { queue_.lose({"display.lost", "display", "it was unplugged", "plug it in"}); }
  double next_s() const { return vblanks_ * mode_.interval_s; }

  std::atomic<bool> opens = true;

 private:
  lightcrafter_emulator::Board& board_;
  VideoMode mode_;
  FrameQueue queue_;
  int vblanks_ = 0;
  std::vector<std::uint32_t> black_ = std::vector<std::uint32_t>(912 * 1140, 0);
};

}  // namespace focalstage
