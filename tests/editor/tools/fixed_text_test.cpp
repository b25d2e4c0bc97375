#include "editor/tools/fixed_text.h"

#include <doctest/doctest.h>

#include <limits>

using namespace focalstage;

TEST_CASE("numbers with a fixed count of decimals") {
  CHECK(fixed_text(0.12, 3) == "0.120");
  CHECK(fixed_text(-2.5, 1) == "-2.5");
  CHECK(fixed_text(-0.0004, 3) == "0.000");
  CHECK(signed_text(0.5, 2) == "+0.50");
  CHECK(signed_text(-0.5, 2) == "-0.50");
  CHECK(signed_text(-0.001, 2) == "0.00");
  CHECK(fixed_text(std::numeric_limits<double>::infinity(), 2) == "\u221e");
  CHECK(fixed_text(1e300, 2).size() == 304);  // 301 digits, a point and two more
}
