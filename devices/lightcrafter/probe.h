#pragma once

#include <vector>

#include "devices/roles/device.h"

namespace focalstage {

/// The LightCrafter 4500s that are plugged in; disturbs none.
std::vector<DeviceId> probe_lightcrafter();

}  // namespace focalstage
