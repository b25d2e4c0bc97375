#include "editor/tools/srgb.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace focalstage;

TEST_CASE("the curve of sRGB, there and back, and what lies outside") {
  // IEC 61966-2-1: mid gray 0.5 is coded 0.735357; the straight part ends at 0.0031308, coded 0.04045.
  CHECK(srgb_from_linear(0.5) == doctest::Approx(0.735357).epsilon(1e-5));
  CHECK(srgb_from_linear(0.0031308) == doctest::Approx(0.04045).epsilon(1e-4));
  CHECK(srgb_from_linear(-0.2) == 0.0);
  CHECK(srgb_from_linear(7.0) == srgb_from_linear(1.0));  // 1.055 - 0.055: one but for its last bit
  for (int i = 0; i <= 100; ++i) {
    CHECK(linear_from_srgb(srgb_from_linear(i / 100.0)) == doctest::Approx(i / 100.0).epsilon(1e-6));
  }
}

TEST_CASE("codes of pictures are the nearest but for the table's steps") {
  CHECK(srgb_code(0.0f) == 0);
  CHECK(srgb_code(1.0f) == 255);
  CHECK(srgb_code(2.0f) == 255);
  for (int i = 0; i <= 1000; ++i) {
    const float linear = static_cast<float>(i) / 1000.0f;
    // Where the curve is steepest, 12.92 x 255 codes per unit, half a step is 0.4 codes; half a code is rounding.
    CHECK(std::abs(srgb_code(linear) - 255.0 * srgb_from_linear(static_cast<double>(linear))) <= 0.91);
  }
}
