#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "devices/player/player.h"
#include "io/protocol/rig_values.h"

namespace focalstage {

/// What the rig says of itself for a sweep of that frequency.
using DescribeRig = std::function<RigDescription(double frequency_hz)>;

/// Opens a show for the rig, or says why this rig will not play it: "rig.refused" (an error finding, beyond a limit),
/// "rig.differs" (made for another rig; each difference and how much), "show.*".
Result<std::shared_ptr<const LoadedShow>> load_show(const std::filesystem::path& path, const std::string& sha256,
                                                    const DescribeRig& rig, const RigLimits& limits);

/// "rig.refused" where handing the plan's sweeps over would meet a limit.
Status within_limits(const SweepPlan& plan, const RigLimits& limits);

/// "rig.differs" where the rig, on the show's own drive and triggers, would be off by more than 0.02 D or 20 us.
Status fits_rig(const ShowHeader& show, const Project& project, const RigDescription& rig);

}  // namespace focalstage
