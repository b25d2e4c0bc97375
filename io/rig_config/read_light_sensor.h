#pragma once

#include "core/scene/value.h"
#include "io/rig_config/light_config.h"

namespace focalstage {

/// From an object that the schema took.
LightSensorConfig light_sensor_from(const Value& value);

}  // namespace focalstage
