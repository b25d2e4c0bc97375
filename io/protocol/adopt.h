#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/check/rig_differences.h"
#include "core/scene/edit.h"
#include "core/scene/project.h"
#include "io/protocol/client.h"

namespace focalstage {

/// The edits that make a project what the rig measured of itself: lens response, shutters, limits; of each projector
/// (by name, else in order) its size, depth, latency and, where the rig is slower, its rate. Only what differs.
std::vector<Edit> adopt(const Project& project, const RigDescription& rig);

/// What a project's rig is held against (core/check/rig_differences.h).
RigValues rig_values_of(const RigDescription& rig);

}  // namespace focalstage
