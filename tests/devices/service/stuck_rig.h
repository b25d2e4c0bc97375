#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "devices/sim/sim_rig.h"
#include "tests/support/forwarding_rig.h"

namespace focalstage {

/// A simulated rig whose time stands still while `stuck` holds: whoever keeps it waits.
class StuckRig final : public support::ForwardingRig {
 public:
  StuckRig(const SimSettings& settings, std::shared_ptr<std::atomic<bool>> stuck)
      : ForwardingRig(std::make_unique<SimRig>(settings)), stuck_(std::move(stuck)) {}

  void run_until(double time_s) override {
    while (*stuck_) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ForwardingRig::run_until(time_s);
  }

 private:
  std::shared_ptr<std::atomic<bool>> stuck_;
};

}  // namespace focalstage
