#pragma once

#include <functional>
#include <vector>

#include "core/base/result.h"
#include "core/compile/frame.h"
#include "core/schedule/projector_models.h"
#include "core/schedule/schedule.h"
#include "devices/player/limits.h"
#include "devices/player/sweep_plan.h"
#include "io/protocol/rig_values.h"

namespace focalstage {

/// What the rig says of itself for a sweep of that frequency.
using DescribeRig = std::function<RigDescription(double frequency_hz)>;

/// On what terms a rig plays anything.
struct RigTerms {
  DescribeRig describe;
  RigLimits limits;
  ProjectorModels models{};
};

/// The plan by which this rig will play the show, whether it was pushed or made live, or why it will not: "rig.refused"
/// (an error finding, beyond a limit), "rig.differs" (made for another rig; each difference and how much), "show.*".
Result<SweepPlan> admit(const ShowHeader& show, const Project& project, const ScheduleResult& schedule,
                        const std::vector<FrameMeasure>& measures, const RigTerms& rig);

/// "rig.refused" where handing the plan's sweeps over would meet a limit.
Status within_limits(const SweepPlan& plan, const RigLimits& limits);

/// "rig.differs" where the rig, on the show's own drive and triggers, would be off by more than 0.02 D or 20 us.
Status fits_rig(const ShowHeader& show, const Project& project, const RigDescription& rig);

}  // namespace focalstage
