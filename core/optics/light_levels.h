#pragma once

#include <vector>

#include "core/scene/project.h"

namespace focalstage {

/// How far from a projector light counts as 1: the compensation's reference, without one its focus, without that 1 m.
double reference_m(const Projector& projector, const Compensation& compensation);

/// Full white of one exposure of each projector, on its axis at its reference, against the least that any of them gives
/// there, which counts as 1. All 1 unless each says its `lumens`.
std::vector<double> light_levels(const Project& project);

}  // namespace focalstage
