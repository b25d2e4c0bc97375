#include "core/percept/focus_peak.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace focalstage;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::vector<double> parabola(const std::vector<double>& focus_d, double top_d) {
  std::vector<double> sharpness;
  for (const double f : focus_d) sharpness.push_back(0.9 - 0.3 * (f - top_d) * (f - top_d));
  return sharpness;
}

}  // namespace

TEST_CASE("a parabola's top is found wherever it lies between the samples") {
  const std::vector<double> even{1.0, 1.1, 1.2, 1.3, 1.4}, uneven{0.5, 1.0, 1.15, 1.4, 2.2};
  for (const std::vector<double>& focus_d : {even, uneven}) {
    for (const double top_d : {1.12, 1.2, 1.23}) {
      const auto peak = focus_peak(focus_d, parabola(focus_d, top_d));
      REQUIRE(peak);
      CHECK(peak->inside);
      CHECK(peak->focus_d == doctest::Approx(top_d).epsilon(1e-9));
      CHECK(peak->sharpness == doctest::Approx(0.9).epsilon(1e-9));
    }
  }
}

TEST_CASE("what rises to the end may peak beyond it") {
  const std::vector<double> focus_d{1.0, 2.0, 3.0};
  const auto rising = focus_peak(focus_d, std::vector{0.2, 0.5, 0.9});
  REQUIRE(rising);
  CHECK_FALSE(rising->inside);
  CHECK(rising->focus_d == 3.0);
  const auto falling = focus_peak(focus_d, std::vector{0.9, 0.5, 0.2});
  REQUIRE(falling);
  CHECK_FALSE(falling->inside);
  CHECK(falling->focus_d == 1.0);
  CHECK_FALSE(focus_peak(std::vector{1.0, 2.0}, std::vector{0.3, 0.4})->inside);
}

TEST_CASE("a level top has its peak in the middle") {
  const std::vector<double> focus_d{1.0, 2.0, 3.0, 4.0, 5.0};
  CHECK(focus_peak(focus_d, std::vector{0.1, 0.5, 0.5, 0.5, 0.1})->focus_d == doctest::Approx(3.0));
  CHECK(focus_peak(focus_d, std::vector{0.1, 0.2, 0.5, 0.5, 0.2})->focus_d == doctest::Approx(3.5));
}

TEST_CASE("a top that blur below a pixel has made level tells by its flanks") {
  std::vector<double> focus_d, sharpness;
  for (int i = 0; i <= 40; ++i) {
    focus_d.push_back(1.0 + 0.05 * i);
    const double off_d = std::abs(focus_d.back() - 2.07);
    // Level within 0.2 D but for what rounding leaves, which must not choose the peak.
    sharpness.push_back(off_d < 0.2 ? 1.0 - 1e-6 * ((i * 7) % 5) : 1.0 - 0.4 * (off_d - 0.2));
  }
  const auto peak = focus_peak(focus_d, sharpness);
  REQUIRE(peak);
  CHECK(peak->focus_d == doctest::Approx(2.07).epsilon(0.01));
}

TEST_CASE("no contrast, no peak") {
  const std::vector<double> focus_d{1.0, 2.0, 3.0};
  CHECK_FALSE(focus_peak(focus_d, std::vector<double>{none, none, none}));
  CHECK_FALSE(focus_peak(focus_d, std::vector{0.0, 0.0, 0.0}));
  CHECK_FALSE(focus_peak({}, {}));
  const auto beside_nothing = focus_peak(focus_d, std::vector<double>{none, 0.5, 0.2});
  REQUIRE(beside_nothing);
  CHECK_FALSE(beside_nothing->inside);
}
