#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "devices/runtime/rig_setup.h"
#include "tests/support/forwarding_rig.h"

namespace focalstage::sample {

/// Light that a rig gave, and where in the picture its middle was, in pixels from the left; none where all is black.
struct SeenLight {
  double start_s = 0.0;
  std::optional<double> middle_px;
};

/// What several threads look at.
class LightLog {
 public:
  void add(const SeenLight& light) {
    const std::lock_guard lock(mutex_);
    seen_.push_back(light);
  }
  std::vector<SeenLight> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(seen_, {});
  }

 private:
  std::mutex mutex_;
  std::vector<SeenLight> seen_;
};

/// The simulated rig, watched by somebody who stands beside it.
class SpyRig final : public support::ForwardingRig {
 public:
  SpyRig(const SimSettings& settings, std::shared_ptr<LightLog> log)
      : ForwardingRig(std::make_unique<SimRig>(settings)),
        width_px_(static_cast<std::size_t>(settings.width_px)),
        log_(std::move(log)) {}

  std::vector<DeliveredExposure> take_delivered() override {
    std::vector<DeliveredExposure> delivered = ForwardingRig::take_delivered();
    for (const DeliveredExposure& exposure : delivered) log_->add({exposure.start_s, middle_of(exposure.picture)});
    return delivered;
  }

 private:
  std::optional<double> middle_of(const Picture& picture) const {
    double sum = 0.0;
    double weighed = 0.0;
    for (std::size_t i = 0; i < picture.codes.size(); ++i) {
      sum += picture.codes[i];
      weighed += picture.codes[i] * (static_cast<double>(i % width_px_) + 0.5);
    }
    if (sum == 0.0) return std::nullopt;
    return weighed / sum;
  }

  std::size_t width_px_;
  std::shared_ptr<LightLog> log_;
};

inline RigSetup spied_rig(const SimSettings& settings, const std::shared_ptr<LightLog>& log) {
  RigSetup setup = simulated_rig(settings);
  setup.make = [=] { return std::make_unique<SpyRig>(settings, log); };
  return setup;
}

}  // namespace focalstage::sample
