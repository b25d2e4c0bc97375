#pragma once

#include <array>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "devices/display/display.h"
#include "devices/planes/frame_packer.h"
#include "devices/roles/picture.h"

namespace focalstage::lightcrafter {

/// Packs the pictures of each period in a thread of its own and hands the frames to a display.
class FrameFeeder {
 public:
  /// `display` must live longer. `most_ahead`: periods that wait, wherever they do.
  FrameFeeder(Display& display, std::size_t most_ahead);

  /// What comes from now on; what waits is forgotten.
  Status arm(const PackPlan& plan);
  /// Frames go to the display from now on, or stay here.
  void go(bool going);

  /// None: a period in the dark. "projector.full", "projector.picture".
  Status post(std::vector<Picture> pictures);
  /// Everything that waits, here and in the display.
  void forget() noexcept;

 private:
  void loop(const std::stop_token& stop);
  std::shared_ptr<std::vector<std::uint32_t>> free_frame(std::size_t pixels);

  Display& display_;
  std::size_t most_ahead_;
  std::mutex mutex_;  ///< held for moments only
  std::condition_variable_any changed_;
  std::shared_ptr<FramePacker> packer_;
  std::deque<std::vector<Picture>> periods_;
  std::array<std::shared_ptr<std::vector<std::uint32_t>>, 6> frames_;
  bool going_ = false;
  bool packing_ = false;
  std::uint64_t forgotten_ = 0;  ///< how often
  std::jthread thread_;
};

}  // namespace focalstage::lightcrafter
