#include "editor/tools/typed_numbers.h"

#include <doctest/doctest.h>

#include <string_view>

using namespace focalstage;

namespace {
TypedNumbers typed(std::string_view keys) {
  TypedNumbers numbers;
  for (const char key : keys) numbers.type(key);
  return numbers;
}
}  // namespace

TEST_CASE("typed numbers") {
  CHECK(typed("0.25").numbers() == std::vector<double>{0.25});
  CHECK(typed("-.5").numbers() == std::vector<double>{-0.5});
  CHECK(typed("1,5 -2").numbers() == std::vector<double>{1.5, -2.0});
  CHECK(typed("-").numbers() == std::vector<double>{0.0});
  CHECK(typed("").numbers().empty());
}

TEST_CASE("what makes no number is not taken") {
  CHECK(typed("1.2.3-x4").text() == "1.234");
  CHECK(typed("  1  2").text() == "1 2");
  TypedNumbers numbers = typed("12");
  CHECK(!numbers.type('e'));
  numbers.backspace();
  numbers.backspace();
  numbers.backspace();
  CHECK(numbers.empty());
}
