#include "devices/catalog/light_catalog.h"

#include "devices/catalog/settings_reader.h"
#include "devices/uno/light_sensor.h"

namespace focalstage {

namespace {

constexpr const char* place = "/devices/light_sensor";

Result<std::shared_ptr<LightSensor>> uno_light(const DeviceConfig& device) {
  SettingsReader reader(device, place);
  UnoLightSettings settings;
  settings.board.path = device.address;
  settings.board.serial = device.serial;
  reader.take("left_input", settings.input.left, 0, 5);
  reader.take("right_input", settings.input.right, 0, 5);
  reader.take("boot_s", settings.board.boot_s, 0.0, 10.0);
  if (Status read = reader.done(); !read) return read.fault();
  return std::shared_ptr<LightSensor>(make_uno_light(settings));
}

}  // namespace

Result<std::shared_ptr<LightSensor>> make_light_sensor(const DeviceConfig& device) {
  if (device.driver == "uno") return uno_light(device);
  return Fault{"rig.config", std::string(place) + "/driver", "no driver \"" + device.driver + "\" does this",
               "choose uno"};
}

}  // namespace focalstage
