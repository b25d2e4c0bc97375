#pragma once

#include "core/base/result.h"
#include "devices/runtime/runtime.h"
#include "io/rig_config/rig_config.h"

namespace focalstage {

RigLimits limits_of(const RigConfig& config);

/// What was measured of the rig, for a sweep of `frequency_hz`: the lenses at its harmonics, straight between the
/// measured frequencies, as far as those and a shaped sweep go.
RigDescription describe_measured(const RigConfig& config, const RigLimits& limits, double frequency_hz);

/// The rig that the file asks for: "rig.no-devices" where this program cannot make it.
Result<RigSetup> rig_of(const RigConfig& config);

/// All that a runtime takes from its file. The store stays empty where the file names none.
Result<RuntimeOptions> runtime_options(const RigConfig& config);

}  // namespace focalstage
