#pragma once

#include <vector>

#include "core/base/result.h"
#include "devices/roles/device.h"
#include "devices/serial/serial_ports.h"

namespace focalstage {

/// Each port with the lens driver's USB ids (03eb:2018), and those of `search.paths`. None is opened.
std::vector<DeviceId> probe_optotune(const SerialSearch& search = {});

/// The one with this USB serial number; the only one where it is empty. "optotune.missing", "optotune.which".
Result<DeviceId> find_optotune(const std::string& serial, const SerialSearch& search);

}  // namespace focalstage
