#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "devices/roles/clock.h"
#include "devices/roles/tracker.h"

namespace focalstage::sample {

/// Says what it is told to, a frame whenever it is asked and `streams`.
class FakeTracker final : public Tracker {
 public:
  Status start() override { return {}; }
  void stop() override {}

  std::shared_ptr<const TrackedFrame> newest() const override {
    const std::lock_guard lock(mutex_);
    if (!streams_) return last_;
    const double now_s = monotonic_s();
    last_ = std::make_shared<const TrackedFrame>(TrackedFrame{++count_, now_s, 0.0, now_s, bodies_});
    return last_;
  }

  TrackerState state() const override {
    const std::lock_guard lock(mutex_);
    TrackerState state;
    state.phase = streams_ ? TrackerPhase::tracking : TrackerPhase::lost;
    if (!streams_) state.fault = Fault{"fake.lost", "fake", "the plug is out", ""};
    return state;
  }

  void see(std::vector<TrackedBody> bodies) {
    const std::lock_guard lock(mutex_);
    bodies_ = std::move(bodies);
  }
  void stream(bool streams) {
    const std::lock_guard lock(mutex_);
    streams_ = streams;
  }

 private:
  mutable std::mutex mutex_;
  mutable std::int64_t count_ = 0;
  mutable std::shared_ptr<const TrackedFrame> last_;
  std::vector<TrackedBody> bodies_;
  bool streams_ = true;
};

}  // namespace focalstage::sample
