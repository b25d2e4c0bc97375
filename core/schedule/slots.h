#pragma once

#include <vector>

#include "core/base/sides.h"
#include "core/optics/image_plan.h"
#include "core/scene/project.h"
#include "core/schedule/schedule.h"
#include "core/schedule/shutter.h"
#include "core/schedule/waveform.h"

namespace focalstage {

/// A power change over one exposure beyond which the picture smears in depth (design section 6).
inline constexpr double most_smear_d = 0.3;

/// How long one exposure of `projector` is.
double exposure_s(const Projector& projector);

/// How far the starts of two exposures of `projector` must lie apart: it neither shows two images at once nor takes
/// more than frames_per_second.
double slot_pitch_s(const Projector& projector);

struct Timing {
  std::vector<Slot> slots;  ///< in time order
  std::vector<SlotTrouble> troubles;
};

/// The exposures alone: `make_schedule` without what the lens and the shutters are told. Cheap enough to try many
/// sweeps.
Timing time_slots(const Project& project, const std::vector<ImageSpec>& images, std::size_t projector = 0);

/// Both eyes' power curves; the shutters follow from them.
PerEye<Result<PowerCurve>> power_curves(const Sweep& sweep);
ShutterPlan shutters_of(const Project& project, const PerEye<Result<PowerCurve>>& curves);

}  // namespace focalstage
