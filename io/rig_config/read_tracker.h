#pragma once

#include <filesystem>

#include "io/rig_config/tracker_config.h"

namespace focalstage {

/// Of a value that the schema took.
DeviceConfig device_from(const Value& value);
TrackerConfig tracker_from(const Value& value, const std::filesystem::path& folder);

}  // namespace focalstage
