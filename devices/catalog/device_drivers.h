#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "devices/roles/device.h"

namespace focalstage {

/// What a runtime asks of a driver about devices that may not be its own rig's. Both are called in threads of the
/// service, one at a time, and may take seconds.
struct DeviceDriver {
  /// What is plugged in, found without disturbing it.
  std::function<Result<std::vector<DeviceId>>()> probe;

  /// Makes the device with that serial show itself; empty: the only one there is.
  std::function<Status(const std::string& serial)> identify;
};

/// By the driver's name.
using DeviceDrivers = std::map<std::string, DeviceDriver>;

/// What can be listed, and made to show itself, of the drivers here. One that a rig plays on is busy, and says so.
DeviceDrivers device_drivers();

}  // namespace focalstage
