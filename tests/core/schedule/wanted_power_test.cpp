#include "core/schedule/wanted_power.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/schedule/lens_response.h"
#include "core/schedule/shape_rules.h"

using namespace focalstage;

namespace {

constexpr double pi = std::numbers::pi;

/// a cos + b cos 2, begun at `from` of the period.
std::vector<double> wave(double a, double b, double from = 0.0, std::size_t count = 240) {
  std::vector<double> power_d;
  for (std::size_t i = 0; i < count; ++i) {
    const double phase = 2.0 * pi * (static_cast<double>(i) / static_cast<double>(count) + from);
    power_d.push_back(0.2 - a * std::cos(phase) + b * std::cos(2.0 * phase));
  }
  return power_d;
}

Glasses glasses(int harmonics) {
  Glasses result;
  for (int n = 0; n <= harmonics; ++n) {
    result.lens_response.left.push_back({n, 38.0 - n, -15.0 * n, {}});
    result.lens_response.right.push_back({n, 35.0 - n, -18.0 * n, {}});
  }
  return result;
}

std::string why(std::vector<double> power_d, const Glasses& lenses) {
  const auto result = wanted_waveform(std::move(power_d), lenses, Side::left);
  if (result) return {};
  CHECK_FALSE(result.fault().message.empty());
  CHECK_FALSE(result.fault().remedy.empty());
  return result.fault().code;
}

}  // namespace

TEST_CASE("a wanted power gets the drive of each eye's own lens, begun at its minimum") {
  const Glasses lenses = glasses(4);
  for (const Side eye : both_sides) {
    const auto waveform = wanted_waveform(wave(1.2, 0.1, 0.35), lenses, eye);
    REQUIRE(waveform.ok());
    CHECK(waveform->power_d.front() == *std::min_element(waveform->power_d.begin(), waveform->power_d.end()));
    CHECK(waveform->power_d[1] == doctest::Approx(wave(1.2, 0.1)[1]).epsilon(1e-9));
    const std::vector<double> made_d = power_from_drive(waveform->drive_a, lenses.lens_response[eye]);
    for (std::size_t i = 0; i < made_d.size(); ++i) CHECK(std::abs(made_d[i] - waveform->power_d[i]) < 1e-9);
    // The first harmonic's current: 1.2 D / g1, whatever the second adds.
    const double gain = eye == Side::left ? 37.0 : 34.0;
    double cosine = 0.0, sine = 0.0;
    for (std::size_t i = 0; i < made_d.size(); ++i) {
      const double phase = 2.0 * pi * static_cast<double>(i) / static_cast<double>(made_d.size());
      cosine += waveform->drive_a[i] * std::cos(phase) * 2.0 / static_cast<double>(made_d.size());
      sine += waveform->drive_a[i] * std::sin(phase) * 2.0 / static_cast<double>(made_d.size());
    }
    CHECK(std::hypot(cosine, sine) == doctest::Approx(1.2 / gain).epsilon(1e-6));
  }
}

TEST_CASE("what is wanted must be a curve that the lens was measured for and bears") {
  const Glasses lenses = glasses(4);
  CHECK(why({}, lenses) == "wanted.curve");
  CHECK(why({1.0}, lenses) == "wanted.curve");
  CHECK(why({0.0, 1.0, 0.5}, lenses) == "wanted.curve");
  std::vector<double> holed = wave(1.0, 0.0);
  holed[7] = std::nan("");
  CHECK(why(holed, lenses) == "wanted.curve");
  CHECK(why(std::vector<double>(64, 0.5), lenses) == "wanted.curve");
  CHECK(why(wave(0.3, 0.6), lenses) == "wanted.curve");  // rises twice
  CHECK(why(wave(11.0, 0.0), lenses) == "wanted.range");
  CHECK(why(wave(1.2, 0.1), glasses(1)) == "wanted.unmeasured");
  CHECK(why(wave(1.2, 0.01), glasses(1)).empty());  // 0.01 D of it is within the rule
  CHECK(why(wave(1.2, 0.1), Glasses{}) == "wanted.unmeasured");
  Glasses mute = glasses(4);
  mute.lens_response.left[2].gain_d_per_a = 0.0;
  CHECK(why(wave(1.2, 0.1), mute) == "wanted.unmeasured");
  std::vector<double> ramp;  // does not come back to where it began
  for (int i = 0; i < 100; ++i) ramp.push_back(-1.0 + 0.02 * i);
  CHECK(why(ramp, lenses) == "wanted.unmeasured");
  Glasses weak = glasses(4);
  weak.lens_limits.emplace().max_current_a = 0.03;
  CHECK(why(wave(1.2, 0.1), weak) == "wanted.current");
  weak.lens_limits = LensLimits{};
  weak.lens_limits->max_rms_current_a = 0.02;
  CHECK(why(wave(1.2, 0.1), weak) == "wanted.current");
}
