#include "devices/input/motion_watch.h"

#include <utility>

#include "devices/roles/clock.h"

namespace focalstage {

namespace {

// How soon a hand that takes hold is noticed, and how long the end of all this may wait.
constexpr double look_s = 0.010;

}  // namespace

MotionWatch::MotionWatch(std::unique_ptr<MotionInput> input, std::function<void()> wake, double between_openings_s)
    : input_(std::move(input)), wake_(std::move(wake)), between_openings_s_(between_openings_s) {
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void MotionWatch::run(const std::stop_token& stop) {
  double open_at_s = 0.0;
  bool was_there = false;
  Deflection was;
  while (!stop.stop_requested()) {
    if (!present() && monotonic_s() >= open_at_s) {
      (void)input_->open();  // what went wrong is in its state
      open_at_s = monotonic_s() + between_openings_s_;
    }
    const bool there = present();
    const Deflection now = deflection();
    if (there != was_there || now != was) wake_();
    was_there = there;
    was = now;
    sleep_until(monotonic_s() + look_s);
  }
}

}  // namespace focalstage
