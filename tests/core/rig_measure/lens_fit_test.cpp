#include "core/rig_measure/lens_fit.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "tests/core/rig_measure/bench.h"

using namespace focalstage;

namespace {

using Complex = std::complex<double>;

constexpr double period_s = 1.0 / 60.0;

/// The true lens: not what it is thought to be.
struct Lens {
  double rest_d = 0.0;
  double gain_d_per_a = 37.0;
  double lag_s = 0.0009;
  double delay_s = 0.0002;

  Complex factor(int n) const {
    const double omega = 2.0 * std::numbers::pi * n / period_s;
    return gain_d_per_a * std::polar(1.0, -omega * delay_s) / Complex(1.0, omega * lag_s);
  }
  double power_d(const DriveTones& drive, double time_s) const {
    double power_d = rest_d;
    for (std::size_t n = 0; n < drive.amplitude.size(); ++n) {
      const double omega = 2.0 * std::numbers::pi * static_cast<double>(n) / period_s;
      power_d += (factor(static_cast<int>(n)) * drive.amplitude[n] * std::polar(1.0, omega * time_s)).real();
    }
    return power_d;
  }
};

struct Bench {
  bench::Sensor sensor;
  Lens lens;
  std::vector<KnownPower> targets{{-1.0, 0.0}, {1.0, 0.0}};
  std::vector<double> really_d{-1.0, 1.0};  ///< where the lines really stand
  LensResponse nominal{{0, 40.0, 0.0, {}}, {1, 40.0, 0.0, {}}};
  int harmonics = 4;
  double brightness = 0.4;  ///< of a sharp line, of the range
  double slit_d = 0.12;
  int traces = 24;

  LensFitTask task() const {
    const auto drives = lens_drives(targets, nominal, harmonics, 0.29);
    REQUIRE(drives);
    return {period_s, sensor.step_s, targets, *drives, nominal, 0.0};
  }

  Result<LensFit> measured() const {
    const LensFitTask what = task();
    bench::Sensor now = sensor;
    std::vector<LensLook> looks;
    // Two windows of light, each half a sweep and something.
    for (const double from_s : {0.0002, 0.0075}) {
      const auto train = [&](double t) { return bench::exposures(t, from_s, from_s + 0.0090, 0.00035, 0.00002); };
      const auto samples = static_cast<std::size_t>(0.0092 / now.step_s);
      ++now.seed;
      const LightTraces dark = bench::record(
          now, [](double) { return 0.0; }, from_s, samples, traces);
      ++now.seed;
      const LightTraces lit = bench::record(
          now, [&](double t) { return 0.6 * train(t); }, from_s, samples, traces);
      const auto black = dark_light(dark);
      if (!black) return black.fault();
      const auto full = FullLight::make(lit, *black, "left eye");
      if (!full) return full.fault();
      for (std::size_t drive = 0; drive < what.drives.size(); ++drive) {
        for (std::size_t target = 0; target < targets.size(); ++target) {
          const auto light = [&](double t) {
            const double off_d = lens.power_d(what.drives[drive], t) - really_d[target];
            return brightness * train(t) * bench::through_slit(off_d, slit_d);
          };
          ++now.seed;
          looks.push_back({drive, target, full->shares(bench::record(now, light, from_s, samples, traces))});
        }
      }
    }
    return fit_lens(looks, what, "left lens");
  }
};

/// How far each value is from the truth, in its own spreads.
std::vector<double> pulls(const LensFit& fit, const Lens& lens) {
  std::vector<double> found{(fit.rest_power_d.value - lens.rest_d) / fit.rest_power_d.spread};
  for (const MeasuredHarmonic& one : fit.lens) {
    const Complex truth = lens.factor(one.harmonic);
    found.push_back((one.gain_d_per_a.value - std::abs(truth)) / one.gain_d_per_a.spread);
    if (one.harmonic == 0) continue;
    const double off_deg =
        std::arg(std::polar(1.0, one.phase_deg.value * std::numbers::pi / 180.0) / truth) * 180.0 / std::numbers::pi;
    found.push_back(off_deg / one.phase_deg.spread);
  }
  return found;
}

double worst(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

TEST_CASE("gain and phase of every harmonic are found, each within its spread, whatever the sensor adds") {
  Bench bench;
  bench.lens.rest_d = 0.08;
  double squares = 0.0;
  double count = 0.0;
  for (const auto& [bits, hum_hz, noise] : {std::tuple{8, 100.0, 0.002}, std::tuple{10, 50.0, 0.002},
                                            std::tuple{10, 100.0, 0.006}, std::tuple{12, 100.0, 0.001}}) {
    bench.sensor.bits = bits;
    bench.sensor.hum_hz = hum_hz;
    bench.sensor.noise = noise;
    bench.sensor.seed += 1000;
    const auto fit = bench.measured();
    if (!fit) MESSAGE(describe(fit.fault()));
    REQUIRE(fit);
    REQUIRE(fit->lens.size() == 5);
    CAPTURE(bits);
    CAPTURE(hum_hz);
    const std::vector<double> off = pulls(*fit, bench.lens);
    CHECK(worst(off) < 4.0);
    for (const double pull : off) squares += pull * pull;
    count += static_cast<double>(off.size());
    // Good enough to compile by: 0.02 D of 1.5 D.
    CHECK(fit->lens[0].gain_d_per_a.spread < 0.01 * 37.0);
    CHECK(fit->lens[1].gain_d_per_a.spread < 0.005 * 37.0);
    CHECK(fit->lens[1].phase_deg.spread < 0.4);
    CHECK(fit->residual_d < 0.02);
  }
  // The spreads are neither boasts nor excuses.
  CHECK(std::sqrt(squares / count) < 1.5);
  CHECK(std::sqrt(squares / count) > 0.15);
}

TEST_CASE("24 harmonics are told apart") {
  Bench bench;
  bench.harmonics = 24;
  bench.traces = 12;
  bench.nominal.clear();
  for (int n = 0; n <= 24; ++n) bench.nominal.push_back({n, 38.0 / std::hypot(1.0, 0.3 * n), -12.0 * n, {}});
  const auto fit = bench.measured();
  if (!fit) MESSAGE(describe(fit.fault()));
  REQUIRE(fit);
  REQUIRE(fit->lens.size() == 25);
  CHECK(worst(pulls(*fit, bench.lens)) < 4.5);
  // Whole turns are not lost on the way: the last is late by more than half of one.
  for (std::size_t n = 1; n < fit->lens.size(); ++n) {
    const double omega = 2.0 * std::numbers::pi * static_cast<double>(n) / period_s;
    const double lag_deg =
        (std::atan(omega * bench.lens.lag_s) + omega * bench.lens.delay_s) * 180.0 / std::numbers::pi;
    CHECK(std::abs(fit->lens[n].phase_deg.value + lag_deg) < 20.0);
  }
  CHECK(fit->lens[24].gain_d_per_a.spread < 0.2 * std::abs(bench.lens.factor(24)));
}

TEST_CASE("a lens a fifth weaker than thought and twice as late is found all the same") {
  Bench bench;
  bench.lens = {-0.1, 32.0, 0.0015, 0.0002};
  const auto fit = bench.measured();
  if (!fit) MESSAGE(describe(fit.fault()));
  REQUIRE(fit);
  CHECK(worst(pulls(*fit, bench.lens)) < 4.0);
}

TEST_CASE("how well the lines' own powers are known goes into the spreads, and covers lines that stand elsewhere") {
  Bench bench;
  bench.targets = {{-1.0, 0.02}, {1.0, 0.02}};
  bench.really_d = {-1.03, 1.02};
  const auto fit = bench.measured();
  REQUIRE(fit);
  CHECK(worst(pulls(*fit, bench.lens)) < 3.0);
  // 0.02 D each, over 2 D: 0.014 of the gain.
  CHECK(fit->lens[1].gain_d_per_a.spread / std::abs(bench.lens.factor(1)) == doctest::Approx(0.0141).epsilon(0.2));
}

TEST_CASE("a clock that is 200 ppm off after scaling shifts nothing that matters") {
  Bench bench;
  bench.sensor.clock_off = 200e-6;
  const auto fit = bench.measured();
  REQUIRE(fit);
  CHECK(std::abs(fit->lens[1].gain_d_per_a.value - std::abs(bench.lens.factor(1))) < 0.1);
}

TEST_CASE("three lines are better than two") {
  Bench bench;
  const auto two = bench.measured();
  bench.targets = {{-1.0, 0.0}, {0.0, 0.0}, {1.0, 0.0}};
  bench.really_d = {-1.0, 0.0, 1.0};
  const auto three = bench.measured();
  REQUIRE(two);
  REQUIRE(three);
  CHECK(worst(pulls(*three, bench.lens)) < 4.0);
  CHECK(three->lens[4].phase_deg.spread < two->lens[4].phase_deg.spread);
}

TEST_CASE("what a signal cannot answer is refused, with the reason") {
  SUBCASE("no line is seen") {
    Bench bench;
    bench.brightness = 0.0;
    CHECK(bench.measured().fault().code == "measure.light");
  }
  SUBCASE("a line outside of the sweep is never sharp") {
    Bench bench;
    bench.really_d = {-1.0, 4.5};
    const auto fit = bench.measured();
    REQUIRE_FALSE(fit);
    CHECK(fit.fault().code.starts_with("measure."));
    CHECK(fit.fault().where.find("1 D") != std::string::npos);
  }
  SUBCASE("lines that were mixed up fit no lens") {
    Bench bench;
    bench.really_d = {1.0, -1.0};
    const auto fit = bench.measured();
    REQUIRE_FALSE(fit);
    CHECK(fit.fault().code.starts_with("measure."));
  }
  SUBCASE("too much light") {
    Bench bench;
    bench.sensor.ambient = 0.5;
    CHECK(bench.measured().fault().code == "measure.saturated");
  }
  SUBCASE("hum of mains in step with the sweep") {
    Bench bench;
    bench.sensor.hum = 0.1;
    bench.sensor.hum_hz = 60.0;
    CHECK(bench.measured().fault().code == "measure.hum");
  }
  SUBCASE("hum out of step that drowns all") {
    Bench bench;
    bench.sensor.hum = 0.3;
    bench.sensor.ambient = 0.3;
    CHECK(bench.measured().fault().code.starts_with("measure."));
  }
}

TEST_CASE("drives stay within the rig's limit, or are refused with what they would need") {
  const std::vector<KnownPower> targets{{-1.0, 0.01}, {1.0, 0.01}};
  const auto drives = lens_drives(targets, {}, 4, 0.29);
  REQUIRE(drives);
  CHECK(drives->size() == 9);
  for (const DriveTones& drive : *drives) {
    for (int i = 0; i < 500; ++i) CHECK(std::abs(drive.at(i * period_s / 500, period_s)) < 0.29);
    CHECK(drive.samples(8)[2] == doctest::Approx(drive.at(period_s / 4, period_s)));
  }
  // 2.15 D at 40 D/A are 0.054 A.
  const auto weak = lens_drives(targets, {}, 4, 0.05);
  REQUIRE_FALSE(weak);
  CHECK(weak.fault().code == "measure.drive");
  CHECK(weak.fault().message.find("0.05 A") != std::string::npos);
  CHECK(lens_drives({{1.0, 0.01}}, {}, 4, 0.29).fault().code == "measure.targets");
  CHECK(lens_drives({{1.0, 0.01}, {1.2, 0.01}}, {}, 4, 0.29).fault().code == "measure.targets");
}

}  // namespace
