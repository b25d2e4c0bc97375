#include "core/schedule/seen.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace focalstage;

namespace {

constexpr double period_s = 1.0 / 60.0;

/// A lens that runs from -1 to 1 D and back in straight lines, the left shutter open in the first half, one exposure of
/// 0.5 ms in each half.
Schedule two_exposures() {
  Schedule schedule;
  schedule.period_s = period_s;
  for (const Side side : both_sides) {
    for (int i = 0; i < 1000; ++i) schedule.lens_power_d[side].push_back(1.0 - 2.0 * std::abs(1.0 - i / 500.0));
  }
  schedule.shutter.left = {period_s - 0.0015, period_s / 2.0 - 0.0015};
  schedule.shutter.right = {period_s / 2.0 - 0.0015, period_s - 0.0015};
  const auto slot = [](int image, Side eye, double start_s) {
    Slot made;
    made.image = image;
    made.eye = eye;
    made.start_s = start_s;
    made.exposure_s = 0.0005;
    return made;
  };
  schedule.slots = {slot(0, Side::left, 0.004), slot(1, Side::right, period_s / 2.0 + 0.002)};
  return schedule;
}

double sum(const SeenExposure& seen) {
  double all = 0.0;
  for (const PowerShare& part : seen.powers) all += part.share;
  return all;
}

}  // namespace

TEST_CASE("an exposure is cut into the powers that pass meanwhile") {
  const std::vector<SeenExposure> seen = seen_exposures(two_exposures(), {0.003, 0.0001}, Side::left, 5);
  REQUIRE(seen.size() == 1);  // the other eye's finds the shutter closed
  CHECK(seen[0].image == 0);
  CHECK(seen[0].own);
  REQUIRE(seen[0].powers.size() == 5);
  CHECK(sum(seen[0]) == doctest::Approx(1.0));
  for (int part = 0; part < 5; ++part) {
    const double time_s = 0.004 + 0.0005 * (part + 0.5) / 5.0;
    CHECK(seen[0].powers[static_cast<std::size_t>(part)].power_d == doctest::Approx(-1.0 + 240.0 * time_s));
  }
}

TEST_CASE("a shutter runs straight to open and to closed, and repeats") {
  const ShutterCurve curve({period_s - 0.0015, period_s / 2.0 - 0.0015}, {0.003, 0.001}, period_s);
  CHECK(curve.transmission(0.0) == doctest::Approx(0.5));
  CHECK(curve.transmission(period_s) == doctest::Approx(0.5));
  CHECK(curve.transmission(-0.0015) == doctest::Approx(0.0));
  CHECK(curve.transmission(0.0015) == doctest::Approx(1.0));
  CHECK(curve.transmission(0.004) == 1.0);
  CHECK(curve.transmission(period_s / 2.0 - 0.001) == doctest::Approx(0.5));
  CHECK(curve.transmission(period_s / 2.0 + 0.004) == 0.0);
}

TEST_CASE("a shutter too slow for the period never opens or closes whole") {
  // Told to open for 0.3 of a period and to close for 0.7, both 20 ms from end to end: what repeats stays below.
  const ShutterCurve slow({0.0, 0.3 * period_s}, {0.02, 0.02}, period_s);
  CHECK(slow.transmission(0.3 * period_s) == doctest::Approx(0.3 * period_s / 0.02));
  CHECK(slow.transmission(0.9 * period_s) == 0.0);
  const ShutterCurve never({0.0, 0.0}, {0.003, 0.003}, period_s);
  CHECK(never.transmission(0.004) >= 0.0);
  CHECK(never.transmission(0.004) <= 1.0);
  const ShutterCurve ideal({0.0, period_s / 2.0}, {0.0, 0.0}, period_s);
  CHECK(ideal.transmission(0.001) == 1.0);
  CHECK(ideal.transmission(period_s * 0.75) == 0.0);
}

TEST_CASE("what is shown while a shutter still closes leaks") {
  const std::vector<SeenExposure> seen = seen_exposures(two_exposures(), {0.003, 0.006}, Side::left);
  REQUIRE(seen.size() == 2);
  CHECK(seen[1].image == 1);
  CHECK_FALSE(seen[1].own);
  // Told to close 1.5 ms before the middle: 3.5 to 4 ms later, 0.375 of 6 ms are left at the exposure's middle.
  CHECK(sum(seen[1]) == doctest::Approx(1.0 - 3.75 / 6.0).epsilon(0.001));
}

TEST_CASE("nothing scheduled, nothing seen") { CHECK(seen_exposures({}, {0.003, 0.0001}, Side::right).empty()); }
