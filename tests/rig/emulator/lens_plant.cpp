#include "tests/rig/emulator/lens_plant.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace focalstage::rig_emulator {

namespace {
constexpr double kept_s = 0.25;
}

void LensPlant::step(double time_s, double current_a) {
  double state_a = 0.0;
  if (!steps_.empty()) {
    const Step& last = steps_.back();
    state_a = last.current_a + (last.state_a - last.current_a) * std::exp(-(time_s - last.time_s) / settings_.lag_s);
  }
  steps_.push_back({time_s, current_a, state_a});
  while (steps_.size() > 2 && steps_[1].time_s < time_s - kept_s) steps_.pop_front();
}

double LensPlant::power_d(double time_s) const {
  const double at_s = time_s - settings_.delay_s;
  const auto after = std::ranges::upper_bound(steps_, at_s, {}, &Step::time_s);
  if (after == steps_.begin()) return 0.0;
  const Step& last = *std::prev(after);
  const double lagged_a =
      last.current_a + (last.state_a - last.current_a) * std::exp(-(at_s - last.time_s) / settings_.lag_s);
  return settings_.gain_d_per_a * lagged_a;
}

}  // namespace focalstage::rig_emulator
