#pragma once

#include <memory>
#include <string>

#include "core/base/result.h"
#include "devices/roles/tracker.h"

namespace focalstage {

/// The tracker that a command line names: "natnet:HOST" (multicast), "natnet-unicast:HOST", "recording:FILE" (again
/// and again). "tracker.unknown", and what is wrong with the file.
Result<std::shared_ptr<Tracker>> make_tracker(const std::string& text);

/// The same tracker, recorded to a file.
std::shared_ptr<Tracker> recorded(std::shared_ptr<Tracker> tracker, const std::string& path);

}  // namespace focalstage
