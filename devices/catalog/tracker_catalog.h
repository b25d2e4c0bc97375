#pragma once

#include <memory>

#include "core/base/result.h"
#include "devices/roles/tracker.h"
#include "io/rig_config/tracker_config.h"

namespace focalstage {

/// The tracker that a rig.json, or a command line in its place, names. "rig.config" with the place in the file, and
/// what is wrong with a recording. Nothing is opened but that.
Result<std::shared_ptr<Tracker>> make_tracker(const TrackerConfig& config);

}  // namespace focalstage
