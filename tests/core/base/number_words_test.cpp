#include "core/base/number_words.h"

#include <doctest/doctest.h>

#include <limits>

using namespace focalstage;

TEST_CASE("numbers with a fixed count of decimals") {
  CHECK(fixed_text(0.12, 3) == "0.120");
  CHECK(fixed_text(-2.5, 1) == "-2.5");
  CHECK(fixed_text(1.0, 1) == "1.0");
  CHECK(fixed_text(-0.0001, 3) == "0.000");
  CHECK(fixed_text(-0.0004, 3) == "0.000");
  CHECK(fixed_text(-0.0006, 3) == "-0.001");
  CHECK(signed_text(0.5, 2) == "+0.50");
  CHECK(signed_text(-0.5, 2) == "-0.50");
  CHECK(signed_text(-0.001, 2) == "0.00");
  CHECK(fixed_text(std::numeric_limits<double>::infinity(), 2) == "\u221e");
  CHECK(fixed_text(std::numeric_limits<double>::quiet_NaN(), 2) == "?");
  CHECK(fixed_text(1e300, 2).size() == 304);  // 301 digits, a point and two more
}

TEST_CASE("numbers as short as a count of digits lets them be") {
  CHECK(short_text(-0.0) == "0");
  CHECK(short_text(0.30000000001) == "0.3");
  CHECK(short_text(1200.0) == "1200");
  CHECK(short_text(1.2e-7) == "1.2e-07");
  CHECK(short_text(-2.0 / 3.0, 4) == "-0.6667");
  CHECK(short_text(123456.0, 4) == "1.235e+05");
}
