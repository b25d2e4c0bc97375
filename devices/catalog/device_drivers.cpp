#include "devices/catalog/device_drivers.h"

#include "devices/camera/v4l2_camera.h"
#include "devices/lightcrafter/identify.h"
#include "devices/lightcrafter/probe.h"
#include "devices/mcc1208/mcc1208.h"
#include "devices/mcc1208/probe.h"
#include "devices/optotune/optotune.h"
#include "devices/optotune/probe.h"
#include "devices/uno/probe.h"
#include "devices/uno/uno.h"

namespace focalstage {

namespace {

using Found = Result<std::vector<DeviceId>>;

/// Opened for that alone.
Status shown(Device& device) {
  Status done = device.open();
  if (done) done = device.identify();
  device.close();
  return done;
}

/// A device that `make` makes, with settings that have nothing but the serial.
template <class Settings, class Make>
auto identify_by(Make make) {
  return [make](const std::string& serial) {
    Settings settings;
    settings.serial = serial;
    return shown(*make(settings));
  };
}

}  // namespace

DeviceDrivers device_drivers() {
  DeviceDrivers drivers;
  drivers["camera"] = {
      []() -> Found { return probe_v4l2(*kernel_v4l2()); },
      [](const std::string&) -> Status {
        return Fault{"camera.identify", "camera", "a camera has nothing to show", "cover it, and look at its picture"};
      }};
  drivers["lightcrafter"] = {[]() -> Found { return probe_lightcrafter(); },
                             [](const std::string& serial) { return identify_lightcrafter(serial); }};
  drivers["mcc1208"] = {[]() -> Found { return probe_mcc1208(); }, identify_by<Mcc1208Settings>(make_mcc1208)};
  drivers["optotune"] = {[]() -> Found { return probe_optotune(); }, identify_by<OptotuneSettings>(make_optotune)};
  drivers["uno"] = {[]() -> Found { return probe_uno(); }, identify_by<UnoSettings>(make_uno)};
  return drivers;
}

}  // namespace focalstage
