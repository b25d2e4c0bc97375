#pragma once

#include <memory>

#include "core/base/result.h"
#include "devices/roles/light_sensor.h"
#include "io/rig_config/tracker_config.h"

namespace focalstage {

/// The light sensor that a rig.json names; not opened yet. "rig.config".
Result<std::shared_ptr<LightSensor>> make_light_sensor(const DeviceConfig& device);

}  // namespace focalstage
