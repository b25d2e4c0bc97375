#include "core/schedule/lens_response.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace focalstage;

namespace {

constexpr double pi = std::numbers::pi;

std::vector<double> cosine(std::size_t count, double mean, double size, int harmonic, double phase_deg) {
  std::vector<double> samples(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = 2.0 * pi * static_cast<double>(i) / static_cast<double>(count);
    samples[i] = mean + size * std::cos(harmonic * turn + phase_deg * pi / 180.0);
  }
  return samples;
}

LensHarmonic entry(int harmonic, double gain_d_per_a, double phase_deg) {
  return {harmonic, gain_d_per_a, phase_deg, {}};
}

void check_same(const std::vector<double>& is, const std::vector<double>& want) {
  REQUIRE(is.size() == want.size());
  for (std::size_t i = 0; i < is.size(); ++i) CHECK(is[i] == doctest::Approx(want[i]).epsilon(1e-12));
}

}  // namespace

TEST_CASE("without a response the lens takes 25 mA per dioptre") {
  check_same(drive_for_power({-2.0, 1.0, 4.0}, {}), {-0.05, 0.025, 0.1});
}

TEST_CASE("a lag is led by the drive, a weaker gain driven harder") {
  // Wanted: 0.4 + 1.5 cos. Static gain 50, first harmonic 30 D/A and 20 degrees late.
  const LensResponse response{entry(0, 50.0, 0.0), entry(1, 30.0, -20.0)};
  check_same(drive_for_power(cosine(64, 0.4, 1.5, 1, 0.0), response), cosine(64, 0.4 / 50.0, 1.5 / 30.0, 1, 20.0));
}

TEST_CASE("a harmonic not listed has 40 D/A and no lag, whatever its neighbours have") {
  const LensResponse response{entry(1, 30.0, -20.0)};
  check_same(drive_for_power(cosine(64, 0.8, 1.5, 2, 33.0), response), cosine(64, 0.8 / 40.0, 1.5 / 40.0, 2, 33.0));
}

TEST_CASE("the response undoes its inverse") {
  const LensResponse response{entry(3, 5.0, -170.0), entry(0, 42.0, 0.0), entry(1, 38.0, -14.0), entry(2, -31.0, 90.0)};
  std::vector<double> power_d(100);
  for (std::size_t i = 0; i < power_d.size(); ++i) power_d[i] = std::abs(static_cast<double>(i) - 50.0) / 17.0 - 1.0;
  check_same(power_from_drive(drive_for_power(power_d, response), response), power_d);
}

TEST_CASE("of repeated harmonics the first counts, and impossible ones do no harm") {
  const std::vector<double> power_d = cosine(32, 0.0, 1.0, 1, 0.0);
  const LensResponse plain{entry(1, 20.0, 0.0)};
  const LensResponse odd{entry(1, 20.0, 0.0), entry(1, 99.0, 45.0), entry(-2, 7.0, 0.0), entry(16, 1.0, 0.0),
                         entry(900, 1.0, 0.0)};
  CHECK(drive_for_power(power_d, odd) == drive_for_power(power_d, plain));
  for (const double drive_a : drive_for_power(power_d, {entry(1, 0.0, 0.0)})) CHECK(std::abs(drive_a) < 1e-15);
  CHECK(drive_for_power({}, odd).empty());
}

TEST_CASE("of two lenses with one current, neither strays further from what was asked than the other") {
  const LensResponse left{entry(0, 40.0, 0.0), entry(1, 36.0, -14.0), entry(2, 20.0, 175.0)};
  const LensResponse right{entry(1, 38.0, -12.0), entry(2, 22.0, -178.0)};
  const LensResponse middle = halfway(left, right);
  REQUIRE(middle.size() == 3);
  const std::size_t count = 96;
  const std::vector<double> wanted_d = cosine(count, 0.0, 1.0, 1, 30.0);
  const std::vector<double> drive_a = drive_for_power(wanted_d, middle);
  const auto worst_d = [&](const LensResponse& lens) {
    const std::vector<double> made_d = power_from_drive(drive_a, lens);
    double worst = 0.0;
    for (std::size_t i = 0; i < count; ++i) worst = std::max(worst, std::abs(made_d[i] - wanted_d[i]));
    return worst;
  };
  // |36 cis(-14) - 38 cis(-12)| / |36 cis(-14) + 38 cis(-12)|, by hand.
  CHECK(strays(left[1], right[0]) == doctest::Approx(0.0321).epsilon(0.01));
  CHECK(worst_d(left) == doctest::Approx(strays(left[1], right[0])).epsilon(0.01));
  CHECK(worst_d(right) == doctest::Approx(worst_d(left)).epsilon(0.01));
  // Across the half turn there is no long way round.
  CHECK(std::abs(middle[2].phase_deg) == doctest::Approx(178.7).epsilon(0.001));
  CHECK(middle[2].gain_d_per_a == doctest::Approx(21.0).epsilon(0.01));
  CHECK(halfway(left, left) == left);
  CHECK(halfway({}, {}).empty());
}

TEST_CASE("poles the other way round leave a static gain its sign") {
  const LensResponse middle = halfway({entry(0, -40.0, 0.0)}, {entry(0, -36.0, 0.0)});
  REQUIRE(middle.size() == 1);
  CHECK(middle[0].gain_d_per_a == doctest::Approx(-38.0));
  CHECK(middle[0].phase_deg == 0.0);
}
