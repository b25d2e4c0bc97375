#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/scene/project.h"

namespace focalstage {

/// What a wanted power may lose to harmonics at which the lens was never measured: the rule of delivery.
inline constexpr double most_unmeasured_d = 0.02;

/// The waveform whose power is `power_d`, one period of uniform samples of one eye, begun wherever it was: turned to
/// start at its minimum, with the drive that makes it through the eye's lens response.
///
/// Faults: "wanted.curve" (fewer than eight samples, no finite numbers, not one rise and one fall), "wanted.range"
/// (beyond the lens), "wanted.unmeasured" (over 0.02 D of it in harmonics that the response does not list, or that the
/// lens does not answer: also where the last sample does not lead to the first), "wanted.current" (beyond
/// `lens_limits`).
Result<MeasuredWaveform> wanted_waveform(std::vector<double> power_d, const Glasses& glasses, Side eye);

}  // namespace focalstage
