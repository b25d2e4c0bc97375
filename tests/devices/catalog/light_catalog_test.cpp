#include "devices/catalog/light_catalog.h"

#include <doctest/doctest.h>

namespace focalstage {
namespace {

TEST_CASE("the light sensor of a rig.json is made, and what cannot be is named by its place in the file") {
  const auto made =
      make_light_sensor({"uno", "7583", "", {{"left_input", 2.0}, {"right_input", 3.0}, {"boot_s", 1.0}}});
  REQUIRE(made);
  CHECK((*made)->state().phase == DevicePhase::off);
  CHECK((*made)->abilities().most_samples == 240);
  const auto place = [](const DeviceConfig& device) {
    const auto refused = make_light_sensor(device);
    REQUIRE_FALSE(refused);
    CHECK(refused.fault().code == "rig.config");
    return refused.fault().where;
  };
  CHECK(place({"mcc1208", "", "", {}}) == "/devices/light_sensor/driver");
  CHECK(place({"uno", "", "", {{"left_input", 6.0}}}) == "/devices/light_sensor/settings/left_input");
  CHECK(place({"uno", "", "", {{"gain", 6.0}}}) == "/devices/light_sensor/settings/gain");
}

}  // namespace
}  // namespace focalstage
