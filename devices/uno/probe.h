#pragma once

#include <vector>

#include "devices/roles/device.h"
#include "devices/uno/settings.h"

namespace focalstage {

/// The boards that are plugged in, and the port that the settings name if it is there. Opens nothing: whether the
/// firmware is on them shows when they are opened.
std::vector<DeviceId> probe_uno(const UnoSettings& settings = {});

/// The one that the settings mean. "uno.absent": it is not there; "uno.several": there are more and no serial says
/// which.
Result<DeviceId> find_uno(const UnoSettings& settings);

}  // namespace focalstage
