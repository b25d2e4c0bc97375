#include "devices/player/limits.h"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "tests/devices/player/recording_rig.h"

namespace focalstage {
namespace {

constexpr double period_s = 1.0 / 60.0;

TEST_CASE("a current at the limit passes, a hair beyond it nothing does") {
  RecordingRig rig;
  LimitedRig limited(rig, {});
  limited.set_drive(Side::left, std::vector{0.29, -0.29}, 0.001);
  CHECK_FALSE(limited.fault());
  limited.set_drive(Side::right, std::vector{0.0, -0.2901}, 0.001);
  REQUIRE(limited.fault());
  CHECK(limited.fault()->code == "limit.lens-current");
  CHECK(limited.fault()->where == "right lens");
  limited.sync_edge(1.0);
  CHECK(rig.sweeps.empty());
  limited.reset();
  limited.sync_edge(2.0);
  CHECK(rig.sweeps.size() == 1);
}

TEST_CASE("a drive that is no number does not pass") {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    RecordingRig rig;
    LimitedRig limited(rig, {});
    limited.set_drive(Side::left, std::vector{0.1, bad, 0.1}, 0.001);
    CHECK(limited.fault());
  }
}

TEST_CASE("the first fault is the one that stays") {
  RecordingRig rig;
  LimitedRig limited(rig, {});
  limited.set_drive(Side::left, std::vector{1.0}, 0.001);
  limited.set_exposure(-1.0, {});
  CHECK(limited.fault()->code == "limit.lens-current");
}

TEST_CASE("shutters may change twice a sweep at 60 Hz, not at 110") {
  for (const double frequency_hz : {60.0, 99.0, 110.0}) {
    RecordingRig rig;
    LimitedRig limited(rig, {});
    for (int n = 0; n < 3; ++n) {
      const double start_s = 1.0 + n / frequency_hz;
      limited.sync_edge(start_s);
      limited.shutter(Side::left, ShutterLevel::closed, start_s);
      limited.shutter(Side::left, ShutterLevel::open, start_s + 0.3 / frequency_hz);
    }
    // 2 changes a sweep against 200 a second: 100 Hz is the edge.
    CHECK(limited.fault().has_value() == (frequency_hz > 100.0));
  }
}

TEST_CASE("telling a shutter what it does already is no change") {
  RecordingRig rig;
  LimitedRig limited(rig, {});
  limited.sync_edge(1.0);
  for (int n = 0; n < 50; ++n) limited.shutter(Side::left, ShutterLevel::closed, 1.0 + 0.0001 * n);
  CHECK_FALSE(limited.fault());
  CHECK(rig.sweeps[0].shutter_commands == 1);
}

TEST_CASE("light may be on for 80 % of a sweep") {
  // 0.8 / 60 s hold 26 exposures of 0.5 ms (13.0 of 13.3 ms); the 27th is too much.
  RecordingRig rig;
  LimitedRig limited(rig, {});
  limited.set_exposure(0.0005, {});
  limited.sync_edge(1.0);
  limited.sync_edge(1.0 + period_s);
  for (int n = 0; n < 26; ++n) limited.trigger(1.0 + period_s + 0.0005 * n);
  CHECK_FALSE(limited.fault());
  limited.trigger(1.0 + period_s + 0.0005 * 26);
  REQUIRE(limited.fault());
  CHECK(limited.fault()->code == "limit.light");
  CHECK(rig.sweeps[1].trigger_s.size() == 26);
}

TEST_CASE("darkness always passes") {
  RecordingRig rig;
  LimitedRig limited(rig, {});
  limited.set_drive(Side::left, std::vector{1.0}, 0.001);
  limited.dark(3.0);
  CHECK(rig.dark_s == std::vector{3.0});
}

}  // namespace
}  // namespace focalstage
