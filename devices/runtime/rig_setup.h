#pragma once

#include <functional>
#include <memory>

#include "devices/player/limits.h"
#include "devices/roles/rig.h"
#include "devices/sim/sim_rig.h"
#include "io/protocol/rig_values.h"

namespace focalstage {

/// Which rig a runtime plays on.
struct RigSetup {
  std::function<std::unique_ptr<Rig>()> make;

  /// What it says of itself, for a sweep of that frequency.
  std::function<RigDescription(const RigLimits& limits, double frequency_hz)> describe;
};

RigSetup simulated_rig(const SimSettings& settings = {}, const SimFaults& faults = {});

}  // namespace focalstage
