#include "core/compile/frame.h"

#include <doctest/doctest.h>

using namespace focalstage;

TEST_CASE("ten times less squared error is ten decibels") {
  const OptimalMeasure measure{4, 3, 0, 1000, 10.0, 1.0};
  CHECK(psnr_db(measure, measure.linear_error) == doctest::Approx(20.0));
  CHECK(gain_db(measure) == doctest::Approx(10.0));
  CHECK(gain_db({}) == 0.0);
  CHECK(gain_db({1, 1, 0, 10, 1.0, 0.0}) == doctest::Approx(110.0));  // no error at all is 120 dB
}

TEST_CASE("measures add up") {
  const OptimalMeasure sum = OptimalMeasure{1, 2, 3, 4, 5.0, 6.0} + OptimalMeasure{10, 20, 30, 40, 50.0, 60.0};
  CHECK(sum == OptimalMeasure{11, 22, 33, 44, 55.0, 66.0});
}
