#include "devices/sim/sim_lens.h"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

namespace focalstage {
namespace {

constexpr double period_s = 1.0 / 60.0;
constexpr std::size_t samples = 1000;
constexpr double omega = 2.0 * std::numbers::pi * 60.0;

std::vector<double> sine_drive(double mean_a, double amplitude_a, int harmonic = 1) {
  std::vector<double> drive_a(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(samples);
    drive_a[i] = mean_a + amplitude_a * std::sin(harmonic * turn);
  }
  return drive_a;
}

SimLens swinging(const SimLensSettings& settings, int harmonic = 1) {
  SimLens lens(settings);
  lens.play(sine_drive(0.01, 0.04, harmonic), period_s / samples, 0.0);
  return lens;
}

double expected_d(const LensPoint& point, double static_gain, double time_s, int harmonic = 1) {
  const double phase = point.phase_deg * std::numbers::pi / 180.0;
  return 0.01 * static_gain + 0.04 * point.gain_d_per_a * std::sin(harmonic * omega * time_s + phase);
}

TEST_CASE("the described response of the left lens at 60 Hz") {
  // omega lag = 377 * 0.0006 = 0.226195: gain 38 / sqrt(1 + 0.051164) = 37.0637, phase -(12.7455 + 2.16) degrees.
  const LensPoint point = lens_point({38.0, 0.0006, 0.0001}, 60.0);
  CHECK(point.gain_d_per_a == doctest::Approx(37.063664).epsilon(1e-7));
  CHECK(point.phase_deg == doctest::Approx(-14.905518).epsilon(1e-7));
  CHECK(lens_point({38.0, 0.0006, 0.0001}, 0.0).gain_d_per_a == 38.0);
}

TEST_CASE("a sine comes out with the described gain and phase at each harmonic") {
  const SimLensSettings settings{38.0, 0.0006, 0.0001};
  for (const int harmonic : {1, 2, 5}) {
    SimLens lens = swinging(settings, harmonic);
    const LensPoint point = lens_point(settings, 60.0 * harmonic);
    for (int i = 0; i < 97; ++i) {
      const double time_s = 3.0 * period_s + i * 0.000173;
      CHECK(lens.power_d(time_s) == doctest::Approx(expected_d(point, 38.0, time_s, harmonic)).epsilon(0.0002));
    }
  }
}

TEST_CASE("a step of the drive is followed as exp(-t / lag) after the delay") {
  SimLens lens({40.0, 0.002, 0.001});
  lens.play({0.1, 0.1}, 0.001, 1.0);
  CHECK(lens.power_d(0.9999) == doctest::Approx(0.0));
  CHECK(lens.power_d(1.0009) == doctest::Approx(0.0).epsilon(1e-9));
  // One lag after the delay: 4 D (1 - 1/e); the output stage's microsecond costs half of a microsecond's worth.
  CHECK(lens.power_d(1.003) == doctest::Approx(4.0 * (1.0 - std::exp(-1.0))).epsilon(0.0003));
  lens.stop(1.1);
  CHECK(lens.power_d(1.1) == doctest::Approx(4.0));
  CHECK(lens.power_d(1.103) == doctest::Approx(4.0 * std::exp(-1.0)).epsilon(0.001));
  CHECK(std::abs(lens.power_d(1.2)) < 1e-9);
}

TEST_CASE("sync edges that come when the period ends change nothing, a late one shifts what follows") {
  const SimLensSettings settings;
  SimLens free = swinging(settings);
  SimLens edged = swinging(settings);
  for (int n = 1; n <= 6; ++n) edged.restart(n * period_s);
  for (int i = 0; i < 50; ++i) {
    const double time_s = 5.0 * period_s + i * 0.0003;
    CHECK(edged.power_d(time_s) == doctest::Approx(free.power_d(time_s)).epsilon(1e-9));
  }
  SimLens shifted = swinging(settings);
  shifted.restart(6.0 * period_s + 0.001);
  const double settled_s = 9.0 * period_s + 0.0042;
  CHECK(shifted.power_d(settled_s + 0.001) == doctest::Approx(free.power_d(settled_s)).epsilon(1e-6));
}

TEST_CASE("faults that nobody is told of: lag and gain") {
  const SimLensSettings settings;
  SimLens truth = swinging(settings);
  SimLens late = swinging(settings);
  late.add_lag(0.001);
  SimLens weak = swinging(settings);
  weak.scale_gain(0.9);
  for (int i = 0; i < 50; ++i) {
    const double time_s = 4.0 * period_s + i * 0.0003;
    CHECK(late.power_d(time_s + 0.001) == doctest::Approx(truth.power_d(time_s)).epsilon(1e-9));
    CHECK(weak.power_d(time_s) == doctest::Approx(0.9 * truth.power_d(time_s)).epsilon(1e-12));
  }
}

TEST_CASE("forgetting the past does not change the present") {
  SimLens keeps = swinging({});
  SimLens forgets = swinging({});
  for (int n = 1; n < 40; ++n) {
    const double time_s = n * 0.0077;
    forgets.forget_before(time_s - 0.02);
    CHECK(forgets.power_d(time_s) == keeps.power_d(time_s));
  }
}

}  // namespace
}  // namespace focalstage
