#pragma once

#include <vector>

#include "core/base/rigid.h"
#include "core/calibrate/picked_points.h"

namespace focalstage {

/// Poses (world from projector) that put four points or more about where they were picked, through the lens of `known`,
/// by OpenCV's SQPnP. Empty where no solver takes them.
std::vector<Rigid> first_poses(const ProjectorModel& known, const std::vector<PickedPoint>& points);

/// The other pose from which nearly flat points look nearly alike: turned about their middle so that their plane leans
/// the other way.
Rigid leaning_the_other_way(const Rigid& world_from_projector, const std::vector<PickedPoint>& points);

}  // namespace focalstage
