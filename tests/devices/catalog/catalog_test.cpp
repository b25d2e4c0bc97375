#include "devices/catalog/catalog.h"

#include <doctest/doctest.h>

#include "devices/catalog/device_drivers.h"
#include "devices/catalog/settings_reader.h"

namespace focalstage {
namespace {

DeviceConfig device(const std::string& driver, Value::Object settings = {}) {
  return {driver, "", "", std::move(settings)};
}

DevicesConfig sound() {
  DevicesConfig devices;
  devices.projector = device("plugin", {{"library", "/nowhere/wire.so"}, {"eye_safe", true}, {"socket", "/tmp/none"}});
  devices.lens_drive = device("mcc1208", {{"amperes_per_volt", 0.12}, {"enable_bit", 3}});
  devices.trigger_board = device("uno", {{"left_opens_high", true}});
  return devices;
}

std::string place_of(const DevicesConfig& devices) {
  const auto made = make_rig_devices(devices);
  return made ? "" : made.fault().where;
}

TEST_CASE("a rig.json's devices are made, and nothing is opened yet") {
  const auto made = make_rig_devices(sound());
  REQUIRE(made);
  CHECK(made->projector->state().phase == DevicePhase::off);
  CHECK(made->lens->state().phase == DevicePhase::off);
  CHECK(made->board->state().phase == DevicePhase::off);
  CHECK(!made->lens->abilities().eyes_apart);
}

TEST_CASE("what cannot be is named by its place in the file") {
  DevicesConfig devices = sound();
  devices.lens_drive = device("mcc1208", {{"amperes_per_volts", 0.12}});
  CHECK(place_of(devices) == "/devices/lens_drive/settings/amperes_per_volts");
  devices.lens_drive = device("mcc1208", {{"most_a", 0.5}});
  CHECK(place_of(devices) == "/devices/lens_drive/settings/most_a");
  devices.lens_drive = device("mcc1208", {{"samples", 400.5}});
  CHECK(place_of(devices) == "/devices/lens_drive/settings/samples");
  devices.lens_drive = device("mcc1208", {{"enable_high", "yes"}});
  CHECK(place_of(devices) == "/devices/lens_drive/settings/enable_high");
  devices.lens_drive = device("optotune");
  CHECK(place_of(devices) == "/devices/lens_drive/driver");
  CHECK(make_rig_devices(devices).fault().remedy.find("analogue input") != std::string::npos);
  devices = sound();
  devices.projector = device("lightcrafter", {{"gap", "none"}});
  CHECK(place_of(devices) == "/devices/projector/settings/gap");
  devices.projector = device("lightcrafter", {{"brightness", 1.5}});
  CHECK(place_of(devices) == "/devices/projector/settings/brightness");
  devices = sound();
  devices.trigger_board = device("mega");
  CHECK(place_of(devices) == "/devices/trigger_board/driver");
  devices.trigger_board.reset();
  CHECK(place_of(devices) == "/devices/trigger_board");
}

TEST_CASE("a LightCrafter is a rig's projector, and the master of its time") {
  DevicesConfig devices = sound();
  devices.projector = device(
      "lightcrafter",
      {{"gap", "dark_entry"}, {"shown_bits", 1}, {"display_name", "DLP4500"}, {"input_source", 8}, {"rate_hz", 60}});
  const auto made = make_rig_devices(devices);
  REQUIRE(made);
  CHECK(made->projector->state().phase == DevicePhase::off);
  CHECK(made->projector->abilities().pacing == Pacing::master);
}

TEST_CASE("each driver that has something to plug in can be asked what there is") {
  std::vector<std::string> names;
  for (const auto& [name, driver] : device_drivers()) names.push_back(name);
  CHECK(names == std::vector<std::string>{"camera", "lightcrafter", "mcc1208", "optotune", "uno"});
}

TEST_CASE("what is not plugged in cannot show itself, and says so") {
  for (const auto& [name, driver] : device_drivers()) {
    CAPTURE(name);
    REQUIRE(driver.probe());
    const Status shown = driver.identify("no such serial");
    REQUIRE(!shown);
    CHECK(!shown.fault().message.empty());
  }
}

TEST_CASE("a plugin's own settings reach it as texts") {
  const DeviceConfig config = device("plugin", {{"library", "x"}, {"rate", 2840.0}, {"flip", false}});
  SettingsReader reader(config, "/devices/projector");
  std::string library;
  reader.take("library", library);
  std::string told;
  reader.rest([&](const std::string& key, const std::string& text) { told += key + "=" + text + ";"; });
  CHECK(reader.done());
  CHECK(told == "rate=2840;flip=false;");
}

}  // namespace
}  // namespace focalstage
