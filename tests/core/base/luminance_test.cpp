#include "core/base/luminance.h"

#include <doctest/doctest.h>

using namespace focalstage;

TEST_CASE("luminance has Rec. 709's weights, and white has one") {
  CHECK(luminance(1.0, 0.0, 0.0) == 0.2126);
  CHECK(luminance(0.0, 1.0, 0.0) == 0.7152);
  CHECK(luminance(0.0, 0.0, 1.0) == 0.0722);
  CHECK(luminance(1.0, 1.0, 1.0) == doctest::Approx(1.0).epsilon(1e-15));
  CHECK(luminance(0.5f, 0.5f, 0.5f) == doctest::Approx(0.5).epsilon(1e-6));
}
