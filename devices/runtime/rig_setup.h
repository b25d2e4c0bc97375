#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "devices/player/limits.h"
#include "devices/roles/light_sensor.h"
#include "devices/roles/rig.h"
#include "devices/sim/sim_rig.h"
#include "io/protocol/rig_values.h"
#include "io/rig_config/light_config.h"

namespace focalstage {

/// Which rig a runtime plays on.
struct RigSetup {
  std::function<std::unique_ptr<Rig>()> make;

  /// What it says of itself, for a sweep of that frequency.
  std::function<RigDescription(const RigLimits& limits, double frequency_hz)> describe;

  /// Whether both lenses hang on one channel, as far as is known now; none: each has its own.
  std::function<bool()> lenses_share_drive = nullptr;

  /// What looks at its light, and the lines that it knows; none: this rig cannot measure itself.
  std::shared_ptr<LightSensor> light_sensor = nullptr;
  std::vector<LightTargetConfig> light_targets = {};
};

RigSetup simulated_rig(const SimSettings& settings = {}, const SimFaults& faults = {});

}  // namespace focalstage
