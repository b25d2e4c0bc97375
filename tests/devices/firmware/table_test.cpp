#include "devices/firmware/table.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <initializer_list>
#include <random>

#include "devices/firmware/period.h"

namespace {

fs_error checked(fs_table& table, std::initializer_list<unsigned> triggers) {
  fs_table_begin(&table, 33333, 100);
  std::uint16_t index = 0;
  for (const unsigned at : triggers)
    REQUIRE(fs_table_trigger(&table, index++, static_cast<std::uint16_t>(at)) == FS_OK);
  return fs_table_check(&table, index);
}

fs_error shutters(fs_table& table, unsigned lo, unsigned lc, unsigned ro, unsigned rc) {
  fs_table_begin(&table, 33333, 100);
  REQUIRE(fs_table_shutter(&table, FS_LEFT, static_cast<std::uint16_t>(lo), static_cast<std::uint16_t>(lc)) == FS_OK);
  REQUIRE(fs_table_shutter(&table, FS_RIGHT, static_cast<std::uint16_t>(ro), static_cast<std::uint16_t>(rc)) == FS_OK);
  return fs_table_check(&table, 0);
}

bool open_by_definition(unsigned open, unsigned close, unsigned at) {
  for (unsigned i = open; i != close; i = (i + 1) % 16000) {
    if (i == at) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("triggers keep their distance from the edges and from each other") {
  fs_table table{};
  CHECK(checked(table, {}) == FS_OK);
  CHECK(checked(table, {FS_FIRST_MIN}) == FS_OK);
  CHECK(checked(table, {FS_FIRST_MIN - 1}) == FS_RANGE);
  CHECK(checked(table, {1000, 1000 + 100 + FS_GAP_MIN}) == FS_OK);
  CHECK(checked(table, {1000, 1000 + 100 + FS_GAP_MIN - 1}) == FS_RANGE);
  CHECK(checked(table, {2000, 1000}) == FS_RANGE);
  CHECK(checked(table, {33333 - 100 - FS_GAP_MIN}) == FS_OK);
  CHECK(checked(table, {33333 - 100 - FS_GAP_MIN + 1}) == FS_RANGE);
  CHECK(checked(table, {65535}) == FS_RANGE);
}

TEST_CASE("a trigger may be said twice, not left out, and there are 32") {
  fs_table table{};
  fs_table_begin(&table, 33333, 100);
  CHECK(fs_table_trigger(&table, 1, 500) == FS_RANGE);
  for (unsigned i = 0; i < FS_TRIGGERS_MAX; ++i) {
    CHECK(fs_table_trigger(&table, static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(500 + 500 * i)) == FS_OK);
  }
  CHECK(fs_table_trigger(&table, 31, 500 + 500 * 31) == FS_OK);
  CHECK(fs_table_trigger(&table, FS_TRIGGERS_MAX, 30000) == FS_RANGE);
  CHECK(fs_table_trigger(&table, 65535, 30000) == FS_RANGE);
  CHECK(fs_table_check(&table, 31) == FS_INCOMPLETE);
  CHECK(fs_table_check(&table, 32) == FS_OK);
}

TEST_CASE("periods and pulses out of range are refused") {
  fs_table table{};
  for (const unsigned period : {0U, FS_PERIOD_MIN - 1U, FS_PERIOD_MAX + 1U, 65535U}) {
    fs_table_begin(&table, static_cast<std::uint16_t>(period), 100);
    CHECK(fs_table_check(&table, 0) == FS_RANGE);
  }
  for (const unsigned width : {0U, FS_WIDTH_MIN - 1U, FS_WIDTH_MAX + 1U, 65535U}) {
    fs_table_begin(&table, 33333, static_cast<std::uint16_t>(width));
    CHECK(fs_table_check(&table, 0) == FS_RANGE);
  }
}

TEST_CASE("shutters in turns, over the edge and touching: in order; together: refused") {
  fs_table table{};
  REQUIRE(shutters(table, 30333, 13666, 13666, 30333) == FS_OK);
  CHECK(table.open_at_edge == 1);
  REQUIRE(table.changes == 2);
  CHECK(table.change_at[0] == 13666);
  CHECK(table.change_to[0] == 2);
  CHECK(table.change_at[1] == 30333);
  CHECK(table.change_to[1] == 1);
  CHECK(shutters(table, 100, 13667, 13666, 30333) == FS_OVERLAP);
  CHECK(shutters(table, 0, 33332, 200, 300) == FS_OVERLAP);
  CHECK(shutters(table, 30000, 10, 29000, 5) == FS_OVERLAP);
  CHECK(shutters(table, 7, 7, 29000, 5) == FS_OK);
  CHECK(fs_table_shutter(&table, FS_LEFT, 33333, 5) == FS_RANGE);
  CHECK(fs_table_shutter(&table, FS_LEFT, 5, 33333) == FS_RANGE);
}

TEST_CASE("the list of changes says at every tick what the windows say") {
  std::mt19937 random(3);
  for (int round = 0; round < 100; ++round) {
    unsigned at[4];
    for (unsigned& time : at) time = random() % 40 * 400;
    fs_table table{};
    fs_table_begin(&table, 16000, 100);
    REQUIRE(fs_table_shutter(&table, FS_LEFT, static_cast<std::uint16_t>(at[0]), static_cast<std::uint16_t>(at[1])) ==
            FS_OK);
    REQUIRE(fs_table_shutter(&table, FS_RIGHT, static_cast<std::uint16_t>(at[2]), static_cast<std::uint16_t>(at[3])) ==
            FS_OK);
    const bool accepted = fs_table_check(&table, 0) == FS_OK;
    bool together = false;
    for (unsigned time = 0; time < 16000; time += 200) {
      const bool left = open_by_definition(at[0], at[1], time);
      const bool right = open_by_definition(at[2], at[3], time);
      together = together || (left && right);
      unsigned listed = table.open_at_edge;
      for (unsigned i = 0; i < table.changes; ++i) listed = table.change_at[i] <= time ? table.change_to[i] : listed;
      if (accepted) CHECK(listed == (left ? 1U : 0U) + (right ? 2U : 0U));
    }
    CHECK(accepted == !together);
  }
}
