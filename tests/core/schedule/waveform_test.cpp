#include "core/schedule/waveform.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

using namespace focalstage;

namespace {

Sweep sine(double min_d, double max_d) {
  Sweep sweep;
  sweep.min_power_d = min_d;
  sweep.max_power_d = max_d;
  return sweep;
}

Sweep measured(std::vector<double> power_d, std::vector<double> drive_a = {}) {
  Sweep sweep;
  sweep.waveform.left = sweep.waveform.right = MeasuredWaveform{std::move(power_d), std::move(drive_a), {}};
  return sweep;
}

}  // namespace

TEST_CASE("the sine starts at its minimum and peaks at half its period") {
  const PowerCurve curve = *PowerCurve::make(sine(-1.0, 2.0), Side::left);
  CHECK(curve.period_s() == doctest::Approx(1.0 / 60.0));
  CHECK(curve.peak_s() == doctest::Approx(1.0 / 120.0));
  CHECK(curve.power_d(0.0) == doctest::Approx(-1.0));
  CHECK(curve.power_d(1.0 / 120.0) == doctest::Approx(2.0));
  CHECK(curve.power_d(1.0 / 240.0) == doctest::Approx(0.5));
  CHECK(curve.power_d(-1.0 / 240.0) == doctest::Approx(curve.power_d(3.0 / 240.0)));  // periodic
}

TEST_CASE("the halves of a sine pass a power at acos((mid - p) / A) / (2 pi f), and mirrored") {
  const PowerCurve curve = *PowerCurve::make(sine(-1.5, 1.5), Side::left);
  // acos(-2/3) = 2.3005239830; divided by 2 pi 60
  CHECK(*curve.passing_s(1.0, Side::left) == doctest::Approx(6.1023264e-3).epsilon(1e-7));
  CHECK(*curve.passing_s(1.0, Side::right) == doctest::Approx(1.0 / 60.0 - 6.1023264e-3).epsilon(1e-7));
  CHECK(*curve.passing_s(0.0, Side::left) == doctest::Approx(1.0 / 240.0).epsilon(1e-12));
  CHECK(*curve.passing_s(-1.5, Side::left) == doctest::Approx(0.0));
  CHECK(*curve.passing_s(-1.5, Side::right) == doctest::Approx(1.0 / 60.0));
  CHECK(*curve.passing_s(1.5, Side::left) == doctest::Approx(*curve.passing_s(1.5, Side::right)));
  CHECK_FALSE(curve.passing_s(1.5001, Side::left));
  CHECK_FALSE(curve.passing_s(-1.5001, Side::right));
  CHECK_FALSE(curve.passing_s(std::nan(""), Side::left));
}

TEST_CASE("measured samples are joined by straight lines, round the period's end too") {
  // Five samples of a 60 Hz period, 1/300 s apart; the peak is the third.
  const PowerCurve curve = *PowerCurve::make(measured({-2.0, 0.0, 2.0, 1.0, -1.0}), Side::right);
  CHECK(curve.min_d() == -2.0);
  CHECK(curve.max_d() == 2.0);
  CHECK(curve.peak_s() == doctest::Approx(2.0 / 300.0));
  CHECK(curve.power_d(0.5 / 300.0) == doctest::Approx(-1.0));
  CHECK(curve.power_d(4.5 / 300.0) == doctest::Approx(-1.5));  // half-way from -1 back to -2
  CHECK(*curve.passing_s(-1.0, Side::left) == doctest::Approx(0.5 / 300.0));
  CHECK(*curve.passing_s(1.5, Side::left) == doctest::Approx(1.75 / 300.0));
  CHECK(*curve.passing_s(0.0, Side::right) == doctest::Approx(3.5 / 300.0));
  CHECK(*curve.passing_s(-1.5, Side::right) == doctest::Approx(4.5 / 300.0));
  CHECK(*curve.passing_s(-2.0, Side::right) == doctest::Approx(1.0 / 60.0));
}

TEST_CASE("where a curve passes a power, it has that power") {
  std::vector<double> skewed(96);
  for (std::size_t i = 0; i < skewed.size(); ++i) {
    const double phase = 6.283185307179586 * static_cast<double>(i) / 96.0;
    skewed[i] = 0.3 - 2.0 * std::cos(phase + 0.3 * std::sin(phase));
  }
  for (const Sweep& sweep : {sine(-3.0, 0.5), measured(skewed)}) {
    const PowerCurve curve = *PowerCurve::make(sweep, Side::left);
    for (int i = 0; i <= 50; ++i) {
      const double power_d = std::lerp(curve.min_d(), curve.max_d(), i / 50.0);
      for (const Side eye : both_sides) {
        const double time_s = *curve.passing_s(power_d, eye);
        CHECK(curve.power_d(time_s) == doctest::Approx(power_d).epsilon(1e-9));
        CHECK((eye == Side::left ? time_s <= curve.peak_s() + 1e-12 : time_s >= curve.peak_s() - 1e-12));
      }
    }
  }
}

TEST_CASE("what is no curve says why") {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto why = [](const Sweep& sweep) {
    const Result<PowerCurve> curve = PowerCurve::make(sweep, Side::left);
    CHECK_FALSE(curve.ok());
    return curve.ok() ? std::string() : curve.fault().message;
  };
  CHECK(why(measured({})).find("two samples") != std::string::npos);
  CHECK(why(measured({1.0})).find("two samples") != std::string::npos);
  CHECK(why(measured({0.0, 1.0, 1.0, 0.5})).find("after sample 1") != std::string::npos);   // a plateau
  CHECK(why(measured({0.0, 2.0, 1.0, 1.5})).find("after sample 2") != std::string::npos);   // a second rise
  CHECK(why(measured({0.0, 1.0, 2.0, -1.0})).find("after sample 3") != std::string::npos);  // not from its minimum
  CHECK(why(measured({0.0, infinity, 1.0})).find("not a finite") != std::string::npos);
  CHECK(why(measured({0.0, 1.0, 0.5}, {0.0, 0.1})).find("another number") != std::string::npos);
  CHECK(why(measured({0.0, 1.0, 0.5}, {0.0, std::nan(""), 0.0})).find("drive") != std::string::npos);
  CHECK(why(sine(1.0, 1.0)).find("not below") != std::string::npos);
  CHECK(why(sine(-infinity, 1.0)).find("finite") != std::string::npos);
  Sweep still = sine(-1.0, 1.0);
  still.frequency_hz = 0.0;
  CHECK(why(still).find("frequency") != std::string::npos);
}

TEST_CASE("a measured period keeps all its samples in the lens table") {
  std::vector<double> power_d(300);
  for (std::size_t i = 0; i < power_d.size(); ++i) power_d[i] = i <= 180 ? i / 180.0 : (300.0 - i) / 120.0;
  const Sweep sweep = measured(power_d);
  const std::size_t count = lens_sample_count(sweep);
  CHECK(count == 1200);  // the first multiple of 300 from 1024 on
  const std::vector<double> samples_d = PowerCurve::make(sweep, Side::left)->samples_d(count);
  REQUIRE(samples_d.size() == count);
  for (std::size_t i = 0; i < power_d.size(); ++i) CHECK(samples_d[4 * i] == power_d[i]);
  CHECK(samples_d[2] == doctest::Approx(0.5 / 180.0));
}

TEST_CASE("the number of lens samples serves both eyes and stays bounded") {
  CHECK(lens_sample_count(sine(-1.0, 1.0)) == 1024);
  Sweep sweep = sine(-1.0, 1.0);
  sweep.waveform.left = MeasuredWaveform{std::vector<double>(30), {}, {}};
  sweep.waveform.right = MeasuredWaveform{std::vector<double>(400), {}, {}};
  CHECK(lens_sample_count(sweep) == 1200);
  sweep.waveform.right = MeasuredWaveform{std::vector<double>(65521), {}, {}};
  CHECK(lens_sample_count(sweep) == 65536);
  sweep.waveform.right = MeasuredWaveform{};
  CHECK(lens_sample_count(sweep) == 1050);
}
