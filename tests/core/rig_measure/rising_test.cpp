#include "core/rig_measure/rising.h"

#include <doctest/doctest.h>

using namespace focalstage;

TEST_CASE("a rising curve pools what falls, by its mean, and keeps what rises") {
  const std::vector<LightPoint> points{{0.0, 1.0, 0}, {1.0, 3.0, 0}, {2.0, 2.0, 0}, {3.0, 5.0, 0}};
  const RisingCurve curve = rising_curve(points);
  CHECK(curve.value == std::vector<double>{1.0, 2.5, 2.5, 5.0});
  CHECK(curve.time_s == std::vector<double>{0.0, 1.0, 2.0, 3.0});
  CHECK(curve.passing_s(1.75) == doctest::Approx(0.5));
  CHECK(curve.passing_s(3.75) == doctest::Approx(2.5));
  CHECK(curve.passing_s(9.0) == 3.0);
  CHECK(curve.passing_s(0.0) == 0.0);
}
