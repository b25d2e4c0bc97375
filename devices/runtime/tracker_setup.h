#pragma once

#include <memory>
#include <string>

#include "core/base/result.h"
#include "devices/runtime/live_tracking.h"
#include "io/rig_config/tracker_config.h"

namespace focalstage {

/// What a command line says in place of a rig.json: "natnet:HOST" (multicast), "natnet-unicast:HOST", "recording:FILE"
/// (again and again). "tracker.unknown".
Result<TrackerConfig> tracker_named(const std::string& text);

/// The tracker with all that is told of its place and bodies. "rig.config" with the place in the file, and what is
/// wrong with a recording.
Result<TrackerSetup> tracker_setup(const TrackerConfig& config);

/// The same tracker, recorded to a file.
std::shared_ptr<Tracker> recorded(std::shared_ptr<Tracker> tracker, const std::string& path);

}  // namespace focalstage
