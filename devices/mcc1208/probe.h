#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "devices/mcc1208/unit.h"
#include "devices/roles/device.h"

namespace focalstage {

/// Each USB-1208FS-Plus that is plugged in and answers. Only its serial number is asked for: one that plays goes on.
std::vector<DeviceId> probe_mcc1208();

struct FoundMcc1208 {
  DeviceId id;
  std::unique_ptr<MccUnit> unit;
};

/// The one with this serial number, for this process alone; the only one where it is empty ("usb.which" where there are
/// more).
Result<FoundMcc1208> find_mcc1208(const std::string& serial, double answer_s);

}  // namespace focalstage
