#include "devices/sim/sim_rig.h"

#include <doctest/doctest.h>

namespace focalstage {
namespace {

constexpr double period_s = 0.016;

Picture picture(std::uint8_t code) {
  auto bytes = std::make_shared<const std::vector<std::uint8_t>>(4, code);
  return {bytes, *bytes};
}

SimSettings plain_settings() {
  SimSettings settings;
  settings.lens = {{40.0, 0.0005, 0.0}, {20.0, 0.0005, 0.0}};
  settings.projector.latency_s = 0.0002;
  return settings;
}

/// One sweep with a constant drive of 0.05 A: 2 D left, 1 D right.
void hand_over(SimRig& rig, double start_s, std::uint8_t code) {
  const std::vector<double> drive_a(16, 0.05);
  for (const Side eye : both_sides) rig.set_drive(eye, drive_a, period_s / 16);
  rig.set_exposure(0.0005, {});
  rig.post_images({picture(code), picture(static_cast<std::uint8_t>(code + 1))});
  rig.sync_edge(start_s);
  rig.shutter(Side::left, ShutterLevel::open, start_s);
  rig.shutter(Side::right, ShutterLevel::closed, start_s);
  rig.trigger(start_s + 0.005);
  rig.trigger(start_s + 0.010);
}

TEST_CASE("an exposure is remembered with the power of both lenses and what both shutters let through") {
  SimRig rig(plain_settings());
  hand_over(rig, 1.0, 7);
  rig.run_until(1.0054);
  CHECK(rig.take_delivered().empty());  // the light of the first trigger is still on
  rig.run_until(1.016);
  const auto light = rig.take_delivered();
  REQUIRE(light.size() == 2);
  CHECK(light[0].picture.codes[0] == 7);
  CHECK(light[1].picture.codes[0] == 8);
  CHECK(light[0].start_s == doctest::Approx(1.0052).epsilon(1e-12));
  CHECK(light[0].duration_s == 0.0005);
  CHECK(light[1].power_d.left == doctest::Approx(2.0).epsilon(1e-6));
  CHECK(light[1].power_d.right == doctest::Approx(1.0).epsilon(1e-6));
  CHECK(light[0].transmission.left.least == 1.0);
  CHECK(light[0].transmission.right.most == 0.0);
  CHECK(rig.take_delivered().empty());
}

TEST_CASE("an exposure is remembered with how far the power moved during it") {
  SimRig rig(plain_settings());
  hand_over(rig, 1.0, 7);
  // From 0 to 0.1 A and back: once the lag is over the power moves at 40 D/A x 0.1 A / 8 ms, over 0.5 ms by 0.25 D.
  const std::vector<double> triangle{0.0, 0.05, 0.1, 0.05};
  for (const Side eye : both_sides) rig.set_drive(eye, triangle, period_s / 4);
  rig.sync_edge(1.016);
  for (const double trigger_s : {1.0206, 1.0241}) rig.trigger(trigger_s);  // rising; over the turn, 0.7 ms late
  rig.run_until(1.04);
  const auto light = rig.take_delivered();
  REQUIRE(light.size() == 4);
  CHECK(light[0].smear_d.left < 1e-4);  // ten lags after it began: 2 D / e^10
  CHECK(light[2].smear_d.left == doctest::Approx(0.25).epsilon(1e-3));
  CHECK(light[2].smear_d.right == doctest::Approx(0.125).epsilon(1e-3));
  // Over a turn the ends alone would hide what lies between them.
  CHECK(light[3].smear_d.left > 0.02);
  CHECK(light[3].smear_d.left < 0.2);
}

TEST_CASE("dark cuts the light that is on, and nothing handed over for later happens") {
  SimRig rig(plain_settings());
  hand_over(rig, 1.0, 7);
  hand_over(rig, 1.016, 9);
  rig.dark(1.0053);
  rig.run_until(2.0);
  const auto light = rig.take_delivered();
  REQUIRE(light.size() == 1);
  CHECK(light[0].duration_s == doctest::Approx(0.0001).epsilon(1e-6));
  CHECK(rig.shutter_transmission(Side::left, 1.0055) == doctest::Approx(0.0));
  CHECK(rig.power_d(Side::left, 1.02) == doctest::Approx(0.0));
}

TEST_CASE("after darkness a new sweep shows its own images") {
  SimRig rig(plain_settings());
  hand_over(rig, 1.0, 7);
  rig.dark(1.006);
  hand_over(rig, 3.0, 11);
  rig.run_until(4.0);
  const auto light = rig.take_delivered();
  REQUIRE(light.size() == 3);
  CHECK(light[1].picture.codes[0] == 11);
  CHECK(light[2].picture.codes[0] == 12);
  CHECK(light[2].power_d.left == doctest::Approx(2.0).epsilon(1e-6));
}

TEST_CASE("a sweep without images leaves the others theirs") {
  SimRig rig(plain_settings());
  hand_over(rig, 1.0, 7);
  rig.sync_edge(1.016);
  hand_over(rig, 1.032, 9);
  rig.run_until(2.0);
  const auto light = rig.take_delivered();
  REQUIRE(light.size() == 4);
  CHECK(light[2].picture.codes[0] == 9);
  CHECK(light[3].picture.codes[0] == 10);
}

TEST_CASE("a trigger without an image shows black") {
  SimRig rig(plain_settings());
  rig.sync_edge(1.0);
  rig.trigger(1.020);
  rig.run_until(2.0);
  const auto light = rig.take_delivered();
  REQUIRE(light.size() == 1);
  CHECK(light[0].picture.codes.empty());
}

TEST_CASE("how far the clock is moved at a time changes nothing") {
  SimRig at_once(plain_settings());
  SimRig in_steps(plain_settings());
  for (int n = 0; n < 5; ++n) {
    hand_over(at_once, 1.0 + n * period_s, static_cast<std::uint8_t>(10 * n));
    hand_over(in_steps, 1.0 + n * period_s, static_cast<std::uint8_t>(10 * n));
  }
  at_once.run_until(2.0);
  for (int i = 0; i <= 5000; ++i) in_steps.run_until(1.0 + 0.0002 * i);
  const auto a = at_once.take_delivered();
  const auto b = in_steps.take_delivered();
  REQUIRE(a.size() == 10);
  REQUIRE(b.size() == a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].start_s == b[i].start_s);
    CHECK(a[i].power_d == b[i].power_d);
    CHECK(a[i].transmission.left.least == b[i].transmission.left.least);
    CHECK(same_picture(a[i].picture, b[i].picture));
  }
}

}  // namespace
}  // namespace focalstage
