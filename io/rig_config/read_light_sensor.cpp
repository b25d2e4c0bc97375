#include "io/rig_config/read_light_sensor.h"

#include "io/json/checked_value.h"
#include "io/rig_config/read_tracker.h"

namespace focalstage {

namespace {

std::array<int, 4> rectangle_from(const Value& list) {
  std::array<int, 4> rectangle{};
  for (std::size_t i = 0; i < rectangle.size(); ++i) rectangle[i] = static_cast<int>(*(*list.array())[i].number());
  return rectangle;
}

LightTargetConfig target_from(const Value& value) {
  LightTargetConfig target;
  read(value, "power_d", target.power_d);
  read(value, "spread_d", target.spread_d);
  target.rectangle_px.left = rectangle_from(*value.find("left_px"));
  target.rectangle_px.right = rectangle_from(*value.find("right_px"));
  return target;
}

}  // namespace

LightSensorConfig light_sensor_from(const Value& value) {
  return {device_from(value), list_of<LightTargetConfig>(value, "targets", target_from)};
}

}  // namespace focalstage
