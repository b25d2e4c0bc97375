#include "core/base/periodic.h"

#include <doctest/doctest.h>

#include <array>

using namespace focalstage;

TEST_CASE("a periodic curve meets its samples, is straight between them and goes on round") {
  constexpr std::array samples{-1.0, 1.0, 3.0, 0.5};
  CHECK(periodic_at(samples, 0.0) == -1.0);
  CHECK(periodic_at(samples, 0.5) == 3.0);
  CHECK(periodic_at(samples, 0.125) == 0.0);
  CHECK(periodic_at(samples, 0.875) == -0.25);  // from the last back to the first
  CHECK(periodic_at(samples, 1.0) == -1.0);
  CHECK(periodic_at(samples, 7.5) == 3.0);
  CHECK(periodic_at(samples, -0.25) == 0.5);
  CHECK(periodic_at(samples, -1e-20) == -1.0);  // its part of a turn rounds up to a whole one
  CHECK(periodic_at({}, 0.3) == 0.0);
}

TEST_CASE("a time is brought into the period, which its end is no part of") {
  CHECK(wrapped_s(0.25, 1.0) == 0.25);
  CHECK(wrapped_s(1.0, 1.0) == 0.0);
  CHECK(wrapped_s(3.25, 1.0) == 0.25);
  CHECK(wrapped_s(-0.25, 1.0) == 0.75);
  CHECK(wrapped_s(-3.0, 1.0) == 0.0);
  CHECK(wrapped_s(-1e-20, 1.0) == 0.0);
}
