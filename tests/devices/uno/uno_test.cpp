#include "devices/uno/uno.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "devices/uno/probe.h"
#include "tests/devices/uno/plugged_in.h"

using namespace focalstage;
using namespace focalstage::test;
using uno_emulator::Chip;
using uno_emulator::Cycle;
using uno_emulator::PinChange;
using uno_emulator::UnoEmulator;

namespace {

void start(PluggedIn& rig) {
  REQUIRE(outcome_of(rig.uno->open()) == "done");
  REQUIRE(rig.is_synced());
  REQUIRE(outcome_of(rig.uno->load(some_table())) == "done");
  REQUIRE(outcome_of(rig.uno->arm()) == "done");
}

struct Recording {
  std::vector<Cycle> edges;
  std::vector<PinChange> trigger;
  std::vector<PinChange> left;
  std::vector<PinChange> right;
};

Recording recorded(PluggedIn& rig) {
  return rig.board.with([](UnoEmulator& uno) {
    const Chip& chip = uno.chip();
    return Recording{chip.edges, chip.trigger, chip.left, chip.right};
  });
}

/// How far each rise lies from the nearest time of the table, in cycles.
double worst_rise(const Recording& seen, const BoardTable& table, double cycles_per_s) {
  double worst = 0.0;
  for (const PinChange& change : seen.trigger) {
    if (!change.high) continue;
    const auto edge = std::prev(std::upper_bound(seen.edges.begin(), seen.edges.end(), change.at));
    double nearest = 1e9;
    for (const double at_s : table.trigger_s) {
      nearest = std::min(nearest, std::abs(static_cast<double>(change.at - *edge) - at_s * cycles_per_s));
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

}  // namespace

TEST_CASE("a board is found, opened, and is safe; what is open is not opened again") {
  PluggedIn rig;
  const auto found = probe_uno(rig.settings);
  REQUIRE_FALSE(found.empty());
  CHECK(found.back().driver == "uno");
  CHECK(found.back().address == rig.settings.path);
  CHECK(rig.uno->state().phase == DevicePhase::off);
  CHECK_FALSE(rig.uno->dark());
  REQUIRE(rig.uno->open().ok());
  CHECK(rig.uno->state().phase == DevicePhase::ready);
  CHECK(rig.uno->state().heard_s > 0.0);
  CHECK(rig.uno->id().address == rig.settings.path);
  CHECK(rig.uno->open().ok());
  CHECK(rig.is_synced());
  CHECK(rig.made_dark());
  const BoardReport report = rig.uno->report();
  CHECK_FALSE(report.armed);
  CHECK(std::abs(report.period_s.value_or(0.0) - 1.0 / 60.0) < 1e-6);
  wait_s(0.5);
  CHECK(rig.uno->report().edges > report.edges + 15);
  rig.uno->close();
  CHECK(rig.uno->state().phase == DevicePhase::off);
  CHECK(rig.uno->load(some_table()).ok() == false);
  CHECK(rig.uno->open().ok());
}

TEST_CASE("triggers and shutters come when the table has them, also by a clock that is half a percent off") {
  for (const double ppm : {0.0, 5000.0, -5000.0}) {
    CAPTURE(ppm);
    PluggedIn rig({.clock_ppm = ppm});
    start(rig);
    wait_s(0.6);
    CHECK(rig.uno->state().phase == DevicePhase::running);
    CHECK(rig.uno->report().armed);
    CHECK(rig.uno->report().bad_lines == 0);
    const Recording seen = recorded(rig);
    CHECK(seen.trigger.size() > 120);
    // 16 cycles, and 3 that the simulator may see a pin late.
    CHECK(worst_rise(seen, some_table(), 16e6 * (1.0 + 1e-6 * ppm)) <= 19.0);
    CHECK(seen.left.size() > 40);
    CHECK(seen.right.size() > 40);
  }
}

TEST_CASE("a clock that the board does not have right is a period that it measures wrong, and no more") {
  PluggedIn rig({.clock_ppm = 5000.0});
  REQUIRE(rig.uno->open().ok());
  REQUIRE(rig.is_synced());
  CHECK(std::abs(rig.uno->report().period_s.value_or(0.0) - 1.005 / 60.0) < 2e-6);
}

TEST_CASE("dark is dark within 50 ms, also while a table is on its way") {
  BoardTable long_table = some_table();
  long_table.trigger_s.clear();
  for (int k = 0; k < 32; ++k) long_table.trigger_s.push_back(0.5e-3 + 0.4e-3 * k);
  PluggedIn rig;
  REQUIRE(rig.uno->open().ok());
  REQUIRE(rig.is_synced());
  constexpr int rounds = 10;
  int in_time = 0;
  for (int round = 0; round < rounds; ++round) {
    rig.board.misbehave({});
    REQUIRE(rig.uno->load(some_table()).ok());
    REQUIRE(rig.uno->arm().ok());
    std::jthread loader;
    if (round % 2 == 1) {
      rig.board.misbehave({.delay_s = 0.01});
      loader = std::jthread([&] {
        const Status loaded = rig.uno->load(long_table);
        CHECK((loaded ? "loaded" : loaded.fault().code) == "uno.dark");
      });
    }
    wait_s(0.1);
    const double begin_s = monotonic_s();
    const bool told = rig.uno->dark();
    const bool clean = !rig.uno->state().fault.has_value();
    if (told && clean && monotonic_s() - begin_s <= 0.05) ++in_time;
    REQUIRE(rig.made_dark());
    const std::size_t triggers = rig.triggers();
    CHECK_FALSE(rig.uno->report().armed);
    CHECK(rig.uno->state().phase == DevicePhase::ready);
    if (loader.joinable()) loader.join();
    wait_s(0.05);
    CHECK(rig.triggers() == triggers);
    rig.board.with([](UnoEmulator& uno) {
      CHECK_FALSE(uno.chip().trigger_high);
      CHECK(uno.chip().left_high);
      CHECK(uno.chip().right_high);
    });
  }
  MESSAGE(in_time << " of " << rounds << " within 50 ms");
  CHECK(in_time > rounds / 2);  // a crowded machine may spoil some
}

TEST_CASE("while it is armed the board hears of its host every 150 ms at the latest") {
  PluggedIn rig;
  start(rig);
  std::vector<double> silences_s;
  for (int i = 0; i < 7; ++i) {
    rig.board.with([](UnoEmulator& uno) { uno.take_longest_silence(); });
    wait_s(0.3);
    const Cycle silence = rig.board.with([](UnoEmulator& uno) { return uno.take_longest_silence(); });
    silences_s.push_back(static_cast<double>(silence) / 16e6);
  }
  std::ranges::sort(silences_s);
  MESSAGE("median " << silences_s[3] << " s, longest " << silences_s[6] << " s");
  CHECK(silences_s[3] <= 0.15);  // a crowded machine may spoil some
  CHECK(rig.uno->report().armed);
}

TEST_CASE("what the board cannot do is refused, and it stays as it was") {
  PluggedIn rig({.sync_hz = 0.0});
  const auto code_of = [](const Status& status) { return status ? std::string("ok") : status.fault().code; };
  REQUIRE(rig.uno->open().ok());
  CHECK(code_of(rig.uno->arm()) == "board.table");
  BoardTable table = some_table();
  CHECK(code_of(rig.uno->load(table)) == "ok");
  CHECK(code_of(rig.uno->arm()) == "board.unsynced");
  table.trigger_s[1] = table.trigger_s[0] + 50e-6;
  CHECK(code_of(rig.uno->load(table)) == "board.table");
  table = some_table();
  table.shutter.right->open_s = 1e-3;
  const Status both = rig.uno->load(table);
  CHECK(code_of(both) == "board.table");
  CHECK(describe(both.fault()).find("both shutters") != std::string::npos);
  CHECK(code_of(rig.uno->load(some_table())) == "ok");
  rig.board.sync(60.0 * 1.05);
  REQUIRE(rig.is_synced());
  CHECK(code_of(rig.uno->arm()) == "board.unsynced");
  rig.board.sync(60.0);
  CHECK(PluggedIn::soon([&] { return rig.uno->arm().ok(); }));
  CHECK(code_of(rig.uno->identify()) == "uno.running");
  CHECK(rig.uno->report().armed);
}

TEST_CASE("it blinks to be told from others, and moves nothing that it should not") {
  PluggedIn rig;
  REQUIRE(rig.uno->open().ok());
  CHECK(rig.uno->identify().ok());
  wait_s(0.7);
  rig.board.with([](UnoEmulator& uno) { CHECK(uno.chip().lamp.size() >= 4); });
  CHECK(rig.triggers() == 0);
}

TEST_CASE("the level that opens is the settings' own") {
  UnoSettings settings;
  settings.opens_high = {true, false};
  PluggedIn rig({}, {}, settings);
  REQUIRE(rig.uno->open().ok());
  rig.board.with([](UnoEmulator& uno) {
    CHECK_FALSE(uno.chip().left_high);
    CHECK(uno.chip().right_high);
  });
}

TEST_CASE("where a projector is the clock, the lens drive's edge is told against its own") {
  PluggedIn rig;
  REQUIRE(rig.uno->open().ok());
  REQUIRE(rig.is_synced());
  CHECK_FALSE(rig.uno->report().lens);
  rig.board.with([](UnoEmulator& emulator) {
    Chip& chip = emulator.chip();
    const double period = 16e6 / 60.0;
    chip.lens_edge_at(chip.now());  // something is wired to it now, and low
    for (int k = 2; k < 240; ++k) chip.lens_edge_at(chip.edges.back() + static_cast<Cycle>(k * period + 80'000));
    return 0;
  });
  REQUIRE(rig.soon([&] { return rig.uno->report().lens && rig.uno->report().lens->edges > 60; }));
  const LensEdge lens = *rig.uno->report().lens;
  CHECK(lens.after_s == doctest::Approx(0.005).epsilon(0.01));
  CHECK(lens.told_s > 0.0);
}
