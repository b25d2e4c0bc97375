#pragma once

#include <vector>

#include "core/scene/project.h"
#include "io/rig_config/rig_config.h"

namespace focalstage {

/// A lens measured at some frequencies, at the harmonics of a sweep of `frequency_hz`: straight between the measured
/// points, as far as those and a shaped sweep go. The first point is at 0.
LensResponse response_at(const std::vector<ResponsePoint>& points, double frequency_hz);

}  // namespace focalstage
