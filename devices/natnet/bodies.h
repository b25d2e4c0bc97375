#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "devices/natnet/packets.h"
#include "devices/natnet/settings.h"
#include "devices/roles/tracker.h"

namespace focalstage {

/// A pose with the stream's axes turned to +Y up, room and body alike.
Rigid turned_to_y_up(const Rigid& pose, NatNetAxes axes);

/// What a tracker hands on of a frame: names put to ids, axes turned, and nothing that cannot be a pose taken for one.
TrackedFrame tracked_frame(const NatNetFrame& frame, const NatNetServer& server,
                           const std::map<std::int32_t, std::string>& names, NatNetAxes axes, double arrival_s);

}  // namespace focalstage
