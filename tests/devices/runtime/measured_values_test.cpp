#include "devices/runtime/measured_values.h"

#include <doctest/doctest.h>

#include "devices/runtime/configured_rig.h"
#include "tests/support/temporary_folder.h"

namespace focalstage {
namespace {

RigDescription plain(double frequency_hz) {
  RigDescription rig;
  rig.name = "gallery";
  rig.kind = "devices";
  rig.frequency_hz = frequency_hz;
  rig.projectors.emplace_back();
  rig.glasses.lens_response.left = {{0, 30.0, 0.0, {}}};
  rig.glasses.lens_response.right = {{0, 34.0, 0.0, {}}};
  return rig;
}

RigMeasurement two_lenses() {
  RigMeasurement measurement;
  measurement.eye.left.lens = {{0, {40.0, 0.1}, {}}, {1, {36.0, 0.1}, {-10.0, 0.1}}};
  measurement.eye.right.lens = {{0, {42.0, 0.1}, {}}, {1, {36.0, 0.1}, {-20.0, 0.1}}};
  return measurement;
}

TEST_CASE("lenses with a channel each are described apart") {
  const TemporaryFolder folder;
  auto values = MeasuredValues::open(folder.path(), plain);
  REQUIRE(values);
  REQUIRE((*values)->keep(two_lenses()));
  const PerEye<LensResponse> lens = (*values)->describe(60.0).glasses.lens_response;
  CHECK(lens.left[1].phase_deg == -10.0);
  CHECK(lens.right[1].phase_deg == -20.0);
}

TEST_CASE("lenses on one channel are described as one, for they get one current, and are kept apart all the same") {
  const TemporaryFolder folder;
  bool shared = true;
  auto values = MeasuredValues::open(folder.path(), plain, [&] { return shared; });
  REQUIRE(values);
  RigDescription rig = (*values)->describe(60.0);
  CHECK(rig.glasses.lens_response.left == rig.glasses.lens_response.right);
  CHECK(rig.glasses.lens_response.left[0].gain_d_per_a == 32.0);
  REQUIRE((*values)->keep(two_lenses()));
  rig = (*values)->describe(60.0);
  REQUIRE(rig.glasses.lens_response.left.size() == 2);
  CHECK(rig.glasses.lens_response.left == rig.glasses.lens_response.right);
  CHECK(rig.glasses.lens_response.left[0].gain_d_per_a == doctest::Approx(41.0));
  CHECK(rig.glasses.lens_response.left[1].phase_deg == doctest::Approx(-15.0));
  CHECK(rig.measurement == two_lenses());
  shared = false;  // a drive says what it can once it is plugged in
  CHECK((*values)->describe(60.0).glasses.lens_response.right[1].phase_deg == -20.0);
}

TEST_CASE("a rig knows from its lens drive whether lenses share it") {
  RigConfig config;
  config.kind = RigKind::devices;
  config.devices.projector = DeviceConfig{"lightcrafter", "", "", {}};
  config.devices.lens_drive = DeviceConfig{"mcc1208", "", "", {}};
  config.devices.trigger_board = DeviceConfig{"uno", "", "", {}};
  config.measured.emplace();
  const Result<RigSetup> rig = rig_of(config);
  REQUIRE(rig);
  REQUIRE(rig->lenses_share_drive);
  CHECK(rig->lenses_share_drive());
  CHECK(!simulated_rig().lenses_share_drive);
}

}  // namespace
}  // namespace focalstage
