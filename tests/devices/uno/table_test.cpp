#include "devices/uno/table.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "devices/firmware/line.h"
#include "devices/uno/packets.h"

using namespace focalstage;

namespace {

BoardTable table_of(double period_s, std::vector<double> triggers) {
  BoardTable table;
  table.period_s = period_s;
  table.trigger_s = std::move(triggers);
  return table;
}

std::string fault_of(const BoardTable& table) {
  const auto commands = uno::table_commands(table);
  return commands ? "none" : commands.fault().code;
}

}  // namespace

TEST_CASE("seconds become ticks of half a microsecond, in the order the board takes them") {
  BoardTable table = table_of(1.0 / 60.0, {1.25e-3, 2e-3});
  table.shutter.left = ShutterWindow{15e-3, 20e-3};
  table.shutter.right = ShutterWindow{0.0, 10e-3};
  const auto commands = uno::table_commands(table);
  REQUIRE(commands.ok());
  // 20 ms are 3.33333 ms of the next period.
  CHECK(*commands == std::vector<std::string>{"TABLE 33333 200", "TRIG 0 2500", "TRIG 1 4000", "OPEN L 30000 6667",
                                              "OPEN R 0 20000", "COMMIT 2"});
  CHECK(*uno::table_commands(table_of(0.01, {})) == std::vector<std::string>{"TABLE 20000 200", "COMMIT 0"});
}

TEST_CASE("a shutter that closes with the period is not one that never opens") {
  BoardTable table = table_of(10e-3, {});
  table.shutter.left = ShutterWindow{1e-3, 10e-3 - 1e-7};
  CHECK(uno::table_commands(table).value()[1] == "OPEN L 2000 0");
}

TEST_CASE("what the line cannot say is named") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf, -1e-3, 0.04, 1e300}) {
    CAPTURE(bad);
    CHECK(fault_of(table_of(bad, {})) == "board.table");
    CHECK(fault_of(table_of(0.01, {bad})) == "board.table");
    BoardTable table = table_of(0.01, {});
    table.pulse_s = bad;
    CHECK(fault_of(table) == "board.table");
    table = table_of(0.01, {});
    table.shutter.right = ShutterWindow{bad, 5e-3};
    CHECK(fault_of(table) == "board.table");
    table.shutter.right = ShutterWindow{1e-3, bad};
    CHECK(fault_of(table) == "board.table");
  }
  BoardTable table = table_of(0.01, {1e-3, -1e-3});
  CHECK(uno::table_commands(table).fault().where == "trigger 1");
  table = table_of(0.01, {});
  for (const ShutterWindow window : {ShutterWindow{2e-3, 2e-3}, ShutterWindow{3e-3, 2e-3}, ShutterWindow{1e-3, 11e-3},
                                     ShutterWindow{10e-3, 12e-3}, ShutterWindow{0.0, 10e-3}}) {
    table.shutter.left = window;
    CHECK(fault_of(table) == "board.table");
    CHECK(uno::table_commands(table).fault().where == "left shutter");
  }
}

TEST_CASE("whatever a table says, its commands are lines that the board reads, or a fault") {
  std::mt19937_64 random(20);
  std::uniform_real_distribution<double> seconds(-2e-3, 36e-3);
  int good = 0;
  for (int i = 0; i < 20'000; ++i) {
    BoardTable table = table_of(seconds(random), {seconds(random), seconds(random)});
    table.shutter.left = ShutterWindow{seconds(random), seconds(random)};
    const auto commands = uno::table_commands(table);
    if (!commands) continue;
    ++good;
    for (const std::string& command : *commands) {
      const auto line = uno::request(255, command);
      REQUIRE(line.has_value());
      fs_line_reader reader{};
      fs_line_event event = FS_LINE_NONE;
      for (const char byte : *line) event = fs_line_push(&reader, byte);
      REQUIRE(event == FS_LINE_OK);
    }
  }
  CHECK(good > 1000);
}
