#pragma once

#include <filesystem>
#include <vector>

#include "devices/roles/device.h"

namespace focalstage {

/// The files named *.motion in a folder, by name; nothing is opened.
std::vector<DeviceId> probe_sample(const std::filesystem::path& folder);

}  // namespace focalstage
