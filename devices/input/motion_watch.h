#pragma once

#include <functional>
#include <memory>
#include <thread>

#include "devices/roles/motion_input.h"

namespace focalstage {

/// Keeps a motion input open, however often it is unplugged, in a thread of its own; whoever asks waits for nothing.
class MotionWatch {
 public:
  /// `wake`: called in that thread when a hand took hold of it or let go, and when it comes or goes.
  MotionWatch(std::unique_ptr<MotionInput> input, std::function<void()> wake, double between_openings_s = 1.0);

  bool present() const { return input_->state().phase == DevicePhase::ready; }
  Deflection deflection() const { return input_->deflection(); }

 private:
  void run(const std::stop_token& stop);

  std::unique_ptr<MotionInput> input_;
  std::function<void()> wake_;
  double between_openings_s_;
  std::jthread thread_;
};

}  // namespace focalstage
