#include "core/mesh/circle.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

using namespace focalstage;

TEST_CASE("the circle is the C library's within rounding") {
  for (int i = -20000; i <= 20000; ++i) {
    const double angle = i * 0.01237;
    const SinCos at = sin_cos(angle);
    CHECK(std::abs(at.sin - std::sin(angle)) < 4e-16);
    CHECK(std::abs(at.cos - std::cos(angle)) < 4e-16);
  }
}

TEST_CASE("quarters in degrees are exact") {
  for (const int turns : {-3, 0, 5}) {
    CHECK(sin_cos_deg(360.0 * turns).sin == 0.0);
    CHECK(sin_cos_deg(360.0 * turns).cos == 1.0);
    CHECK(sin_cos_deg(360.0 * turns + 90.0).sin == 1.0);
    CHECK(sin_cos_deg(360.0 * turns + 90.0).cos == 0.0);
    CHECK(sin_cos_deg(360.0 * turns + 180.0).cos == -1.0);
    CHECK(sin_cos_deg(360.0 * turns - 90.0).sin == -1.0);
  }
  CHECK(sin_cos_deg(30.0).sin == doctest::Approx(0.5).epsilon(1e-15));
}

TEST_CASE("an angle comes back from its sine and cosine, of any length") {
  for (int i = -314; i <= 314; ++i) {
    const double angle = i * 0.01;
    CHECK(std::abs(angle_of(3.0 * std::sin(angle), 3.0 * std::cos(angle)) - angle) < 1e-15);
  }
  CHECK(angle_of(0.0, -1.0) == doctest::Approx(pi));
  CHECK(angle_of(1e-9, 1.0) == doctest::Approx(1e-9).epsilon(1e-12));
  CHECK(angle_of(0.0, 0.0) == 0.0);
}
