#pragma once

#include <vector>

#include "core/scene/project.h"

namespace focalstage {

// A tunable lens behaves as a linear time-invariant system (the paper, section 3.2): each harmonic of the drive comes
// out as the same harmonic of the power, times a gain and turned by a phase. A response lists some harmonics, each at
// most once (of repeated ones the first counts); all others have 40 D/A and no lag. Both functions take one period of
// uniform samples; a harmonic that these cannot hold (half their number or more) is passed at 40 D/A.

/// The drive, in amperes, that makes the lens follow `power_d`. A harmonic of gain zero cannot be driven and is left
/// out.
std::vector<double> drive_for_power(const std::vector<double>& power_d, const LensResponse& response);

/// The power, in dioptres, that the lens makes of `drive_a`.
std::vector<double> power_from_drive(const std::vector<double>& drive_a, const LensResponse& response);

/// The response halfway between two, for lenses that get one current: neither is nearer to what was asked than the
/// other. Lists each harmonic that either lists, once.
LensResponse halfway(const LensResponse& one, const LensResponse& other);

/// How far each of two lenses with one current strays from what was asked at that harmonic, as a share of it.
double strays(const LensHarmonic& one, const LensHarmonic& other);

}  // namespace focalstage
