#pragma once

#include <deque>

namespace focalstage::rig_emulator {

/// A tunable lens and its current amplifier behind a converter that holds each value until the next: a gain, a
/// first-order lag and a transport delay, solved exactly between the steps.
struct LensPlantSettings {
  double gain_d_per_a = 38.0;
  double lag_s = 0.0006;
  double delay_s = 0.0001;
};

class LensPlant {
 public:
  explicit LensPlant(const LensPlantSettings& settings) : settings_(settings) {}

  /// The current from `time_s` on; times only rise.
  void step(double time_s, double current_a);

  /// Power at `time_s`, not further back than what is kept: a quarter of a second.
  double power_d(double time_s) const;

 private:
  struct Step {
    double time_s;
    double current_a;
    double state_a;  ///< the lagged current at `time_s`
  };

  LensPlantSettings settings_;
  std::deque<Step> steps_;
};

}  // namespace focalstage::rig_emulator
