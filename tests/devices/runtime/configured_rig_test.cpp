#include "devices/runtime/configured_rig.h"

#include <doctest/doctest.h>

#include "core/schedule/sweep_shape.h"

namespace focalstage {
namespace {

RigConfig measured() {
  RigConfig config;
  config.name = "gallery";
  config.kind = RigKind::devices;
  config.devices.projector = DeviceConfig{"lightcrafter", "", "", {}};
  config.measured.emplace();
  config.measured->projector.width_px = 912;
  config.measured->projector.latency_ms = 0.2;
  config.measured->glasses.shutter_open_ms = 2.0;
  config.measured->response.left = {{0, 40, 0}, {100, 30, -20}, {300, 10, -80}};
  config.measured->response.right = {{0, 36, 0}, {4000, 36, -40}};
  return config;
}

TEST_CASE("what was measured is described at the harmonics of any sweep, straight between the points") {
  const RigDescription rig = describe_measured(measured(), {0.2, 150.0, 0.8}, 50.0);
  CHECK(rig.name == "gallery");
  CHECK(rig.kind == "lightcrafter");
  CHECK(rig.lens_current_max_a == 0.2);
  CHECK(rig.shutter_changes_per_s_max == 150.0);
  CHECK(rig.frequency_hz == 50.0);
  REQUIRE(rig.projectors.size() == 1);
  CHECK(rig.projectors[0].width_px == 912);
  CHECK(rig.projectors[0].latency_ms == 0.2);
  CHECK(rig.glasses.shutter_open_ms == 2.0);
  const LensResponse& left = rig.glasses.lens_response.left;
  REQUIRE(left.size() == 7);  // 0 to 300 Hz: beyond, nothing was measured
  const double gain[] = {40, 35, 30, 25, 20, 15, 10};
  const double phase[] = {0, -10, -20, -35, -50, -65, -80};
  for (std::size_t n = 0; n < left.size(); ++n) {
    CHECK(left[n].harmonic == static_cast<int>(n));
    CHECK(left[n].gain_d_per_a == doctest::Approx(gain[n]));
    CHECK(left[n].phase_deg == doctest::Approx(phase[n]));
  }
  CHECK(rig.glasses.lens_response.right.size() == most_shaped_harmonics + 1);
  CHECK(rig.glasses.lens_response.right.back().phase_deg == doctest::Approx(-12.0));
}

TEST_CASE("a runtime's settings come from the file") {
  RigConfig config;
  config.name = "desk";
  config.listen = "127.0.0.1:1";
  config.store = "/srv/shows";
  config.limits.lens_current_max_a = 0.1;
  config.network.connections_max = 7;
  config.clients = {{"a", "", {}}};
  const auto options = runtime_options(config);
  REQUIRE(options);
  CHECK(options->listen == "127.0.0.1:1");
  CHECK(options->store == "/srv/shows");
  CHECK(options->rig.limits.lens_current_max_a == 0.1);
  CHECK(options->network.connections_max == 7);
  CHECK(options->clients == config.clients);
  const RigDescription rig = options->rig.rig.describe(options->rig.limits, 60.0);
  CHECK(rig.name == "desk");
  CHECK(rig.kind == "sim");
  CHECK(rig.lens_current_max_a == 0.1);
}

TEST_CASE("a rig whose device has no driver here is refused, with its place in the file") {
  RigConfig config = measured();
  config.devices.projector->driver = "magic-lantern";
  config.devices.lens_drive = DeviceConfig{"mcc1208", "", "", {}};
  config.devices.trigger_board = DeviceConfig{"uno", "", "", {}};
  const auto options = runtime_options(config);
  REQUIRE_FALSE(options);
  CHECK(options.fault().code == "rig.config");
  CHECK(options.fault().where == "/devices/projector/driver");
  CHECK(options.fault().message.find("magic-lantern") != std::string::npos);
}

}  // namespace
}  // namespace focalstage
