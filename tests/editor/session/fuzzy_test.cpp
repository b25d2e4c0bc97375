#include "editor/session/fuzzy.h"

#include <doctest/doctest.h>

#include <string>

using namespace focalstage;

namespace {

int score(const char* query, const char* text) {
  const auto match = fuzzy_match(query, text);
  REQUIRE(match.has_value());
  return match->score;
}

}  // namespace

TEST_CASE("letters must stand there in their order") {
  CHECK(fuzzy_match("udo", "Undo").has_value());
  CHECK_FALSE(fuzzy_match("odu", "Undo").has_value());
  CHECK_FALSE(fuzzy_match("undoo", "Undo").has_value());
  CHECK_FALSE(fuzzy_match("x", "").has_value());
  CHECK(fuzzy_match("", "Undo")->bytes.empty());
  CHECK(fuzzy_match("   ", "Undo")->score == 0);
}

TEST_CASE("beginnings of words win over letters within, runs over scattered ones, short texts over long") {
  CHECK(score("ar", "Add a rabbit") > score("ar", "Clear"));
  CHECK(score("sim", "Start a simulated rig") > score("sim", "Scale in some room"));
  CHECK(score("save", "Save") > score("save", "Save As..."));
  CHECK(score("push", "Push") > score("push", "Cancel the push"));
}

TEST_CASE("the best places are found, not the first ones") {
  // Greedy from the left would take the l and o of "Close or lo".
  const auto match = fuzzy_match("lo", "close, look");
  REQUIRE(match.has_value());
  CHECK(match->bytes == std::vector<std::size_t>{7, 8});
}

TEST_CASE("case does not count in Latin, Greek and Cyrillic; bytes are those of the text") {
  const auto match = fuzzy_match("кРОл", "Select Кролик");
  REQUIRE(match.has_value());
  CHECK(match->bytes == std::vector<std::size_t>{7, 9, 11, 13});
  CHECK(fuzzy_match("ångström", "ÅNGSTRÖM").has_value());
  CHECK(fuzzy_match("λάμ", "ΛάΜΔΑ").has_value());
  CHECK(fuzzy_match("うさ", "Select 兎 うさぎ").has_value());
  CHECK(fuzzy_match("ё", "Ёлка").has_value());
}

TEST_CASE("broken UTF-8 is no trouble") {
  CHECK(fuzzy_match("a",
                    "\xE3\x81"
                    "a")
            .has_value() == false);  // swallowed by the letter that was cut
  CHECK_FALSE(fuzzy_match("\xFF\xFE", "Undo").has_value());
  CHECK(fuzzy_match("o", std::string(100000, 'o')).has_value());
}
