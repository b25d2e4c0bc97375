#pragma once

#include "devices/player/limits.h"
#include "devices/sim/sim_rig.h"
#include "io/protocol/rig_values.h"

namespace focalstage {

/// What the simulated rig says of itself: its lenses at the harmonics of a sweep of `frequency_hz`.
RigDescription describe_sim(const SimSettings& sim, const RigLimits& limits, double frequency_hz);

}  // namespace focalstage
