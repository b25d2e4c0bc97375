#include "editor/window/base/number_text.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace focalstage;

TEST_CASE("a number is written with its unit, and never as minus nothing") {
  CHECK(number_text(0.5, 3, "m") == "0.500 m");
  CHECK(number_text(-1.25, 2, "D") == "-1.25 D");
  CHECK(number_text(45.0, 1, "°") == "45.0°");
  CHECK(number_text(12.0, 0, "") == "12");
  CHECK(number_text(-0.0004, 3, "m") == "0.000 m");
  CHECK(number_text(-0.0006, 3, "m") == "-0.001 m");
  CHECK(number_text(-0.0, 1, "") == "0.0");
}

TEST_CASE("a typed number may carry blanks, a comma, a sign and a unit") {
  CHECK(typed_number("0.5", "m") == 0.5);
  CHECK(typed_number("  0,5 ", "m") == 0.5);
  CHECK(typed_number("+3", "D") == 3.0);
  CHECK(typed_number("-.25", "D") == -0.25);
  CHECK(typed_number("1e-3", "") == 1e-3);
  CHECK(typed_number("2 D", "D") == 2.0);
  CHECK(typed_number("30 deg", "°") == 30.0);
  CHECK(typed_number("30°", "°") == 30.0);
}

TEST_CASE("lengths come in metres, centimetres and millimetres, each into each") {
  CHECK(typed_number("40 cm", "m").value() == doctest::Approx(0.4).epsilon(1e-12));
  CHECK(typed_number("40cm", "m").value() == doctest::Approx(0.4).epsilon(1e-12));
  CHECK(typed_number("0.004 m", "mm").value() == doctest::Approx(4.0).epsilon(1e-12));
  CHECK(typed_number("4", "mm") == 4.0);  // no unit: the field's own
}

TEST_CASE("what is no number in that unit is none") {
  for (const char* text :
       {"", " ", "-", "abc", "1 2", "1.2.3", "0x10", "inf", "nan", "1e999", "1 D", "1 kg", "1,2,3"}) {
    CAPTURE(text);
    CHECK_FALSE(typed_number(text, "m").has_value());
  }
}

TEST_CASE("what is written reads back") {
  for (const double value : {-3.0, -0.12, 0.0, 0.001, 0.42, 7.5, 1234.5}) {
    CAPTURE(value);
    CHECK(typed_number(number_text(value, 3, "m"), "m").value() == doctest::Approx(value).epsilon(1e-12));
  }
}
