#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "tests/devices/uno/plugged_in.h"

using namespace focalstage;
using namespace focalstage::test;
using uno_emulator::Misbehaviour;
using uno_emulator::UnoEmulator;

namespace {

constexpr uno_emulator::Cycle ms = 16'000;

void start(PluggedIn& rig) {
  REQUIRE(outcome_of(rig.uno->open()) == "done");
  REQUIRE(rig.is_synced());
  REQUIRE(outcome_of(rig.uno->load(some_table())) == "done");
  REQUIRE(outcome_of(rig.uno->arm()) == "done");
  wait_s(0.1);
}

std::string fault_of(const PluggedIn& rig) {
  const auto fault = rig.uno->state().fault;
  return fault ? fault->code : "none";
}

/// Of the last trigger, as the chip counts.
uno_emulator::Cycle last_trigger(PluggedIn& rig) {
  return rig.board.with([](UnoEmulator& uno) { return uno.chip().trigger.empty() ? 0 : uno.chip().trigger.back().at; });
}

}  // namespace

TEST_CASE("a board that goes dark by itself says why, with what to do, and stays dark until it is armed") {
  PluggedIn rig;
  start(rig);
  SUBCASE("no more edges") { rig.board.sync(0.0); }
  SUBCASE("an edge too many") {
    rig.board.with([](UnoEmulator& uno) { uno.chip().edge_at(uno.chip().edges.back() + 8 * ms); });
  }
  SUBCASE("and its own word for it is lost") {
    rig.board.misbehave({.lose_every = 2});
    rig.board.sync(0.0);
  }
  REQUIRE(rig.comes_to(DevicePhase::ready));
  CHECK(fault_of(rig) == "board.sync_lost");
  CHECK_FALSE(rig.uno->state().fault->remedy.empty());
  CHECK_FALSE(rig.uno->report().armed);
  rig.board.misbehave({});
  rig.board.sync(60.0);
  const std::size_t triggers = rig.triggers();
  wait_s(0.4);
  CHECK(rig.triggers() == triggers);
  CHECK(rig.uno->arm().ok());
  CHECK(fault_of(rig) == "none");
  CHECK(PluggedIn::soon([&] { return rig.triggers() > triggers; }));
}

TEST_CASE("told to be dark, it has no more to say of why it went dark by itself: a rig may go again") {
  PluggedIn rig;
  start(rig);
  rig.board.sync(0.0);
  REQUIRE(PluggedIn::soon([&] { return fault_of(rig) == "board.sync_lost"; }));
  CHECK(rig.made_dark());
  CHECK(fault_of(rig) == "none");
  CHECK(rig.uno->state().phase == DevicePhase::ready);
}

TEST_CASE("unplugged while it runs: lost at once, dark, and found again under another name") {
  for (const bool keeps_power : {false, true}) {
    CAPTURE(keeps_power);
    PluggedIn rig;
    start(rig);
    const std::string before = rig.board.path();
    const uno_emulator::Cycle unplugged = rig.board.with([&](UnoEmulator& uno) {
      uno.unplug(keeps_power);
      return uno.chip().now();
    });
    const double begin_s = monotonic_s();
    REQUIRE(rig.comes_to(DevicePhase::lost));
    CHECK(monotonic_s() - begin_s < 0.3);
    CHECK(fault_of(rig) == "serial.gone");
    CHECK_FALSE(rig.uno->report().armed);
    CHECK_FALSE(rig.uno->dark());
    CHECK_FALSE(rig.uno->arm().ok());
    CHECK(rig.uno->open().fault().code == "uno.absent");
    wait_s(0.8);
    // Its own watch has it, by its own clock; the newest line may have been on its way.
    CHECK(last_trigger(rig) <= unplugged + (keeps_power ? 520 : 1) * ms);
    rig.board.with([](UnoEmulator& uno) { uno.plug_in(); });
    CHECK(rig.board.path() != before);
    wait_s(0.1);
    start(rig);
    CHECK(rig.uno->state().phase == DevicePhase::running);
    CHECK(fault_of(rig) == "none");
  }
}

TEST_CASE("silent, deaf or unreadable for 500 ms is lost, and its own watch makes it dark") {
  PluggedIn rig;
  start(rig);
  Misbehaviour how;
  SUBCASE("silent") { how.silent = true; }
  SUBCASE("deaf") { how.deaf = true; }
  SUBCASE("all damaged") { how.damage_every = 1; }
  const uno_emulator::Cycle begin = rig.now();
  const double begin_s = monotonic_s();
  rig.board.misbehave(how);
  REQUIRE(rig.comes_to(DevicePhase::lost));
  CHECK(monotonic_s() - begin_s > 0.35);
  CHECK(monotonic_s() - begin_s < 1.0);
  CHECK(fault_of(rig) == "uno.silent");
  wait_s(0.8);
  // As long as it hears us it runs on: so lost means closed, and that is when its own 500 ms begin.
  CHECK(last_trigger(rig) <= begin + 1300 * ms);
  rig.board.misbehave({});
  start(rig);
  CHECK(fault_of(rig) == "none");
}

TEST_CASE("a bad line is slower, and no more") {
  PluggedIn rig;
  Misbehaviour how;
  SUBCASE("answers damaged") { how.damage_every = 4; }
  SUBCASE("requests damaged") { how.damage_requests_every = 4; }
  SUBCASE("answers lost") { how.lose_every = 5; }
  SUBCASE("answers to other requests") { how.wrong_number_every = 4; }
  SUBCASE("old answers first") { how.stale = true; }
  SUBCASE("late") { how.delay_s = 0.03; }
  SUBCASE("byte by byte") { how.dribble = true; }
  rig.board.misbehave(how);
  start(rig);
  wait_s(0.5);
  CHECK(rig.comes_to(DevicePhase::running));
  CHECK(fault_of(rig) == "none");
  CHECK(PluggedIn::soon([&] { return rig.triggers() > 60; }));
  CHECK((rig.uno->report().bad_lines > 0) == (how.damage_every > 0 || how.damage_requests_every > 0));
  CHECK(rig.made_dark());
}

TEST_CASE("the port may go at any byte: a fault, never a hang, and it opens again") {
  PluggedIn rig({}, {}, quick_boot());
  for (const std::size_t bytes : {0, 1, 5, 30, 31, 45, 60, 75, 90, 130, 200, 300}) {
    CAPTURE(bytes);
    rig.board.misbehave({.unplug_after = bytes});
    const double begin_s = monotonic_s();
    Status done = rig.uno->open();
    if (done) done = rig.uno->load(some_table());
    if (done) done = rig.uno->arm();
    CHECK(rig.comes_to(DevicePhase::lost));
    CHECK(monotonic_s() - begin_s < 3.5);
    CHECK(fault_of(rig) == "serial.gone");
    rig.board.misbehave({});
    rig.board.with([](UnoEmulator& uno) { uno.plug_in(); });
    REQUIRE(rig.uno->open().ok());
    rig.uno->close();
  }
}

TEST_CASE("a program that hangs restarts: lost, and why") {
  PluggedIn rig;
  start(rig);
  rig.board.with([](UnoEmulator& uno) { uno.chip().hang_main_loop(); });
  REQUIRE(rig.comes_to(DevicePhase::lost));
  CHECK(fault_of(rig) == "uno.reset");
  CHECK(rig.uno->state().fault->message.find("watchdog") != std::string::npos);
  start(rig);
}

TEST_CASE("a board that opening resets is open within 3 s") {
  PluggedIn rig({}, {.firmware_elf = "", .resets_when_opened = true, .boot_s = 1.6});
  const double begin_s = monotonic_s();
  REQUIRE(rig.uno->open().ok());
  CHECK(monotonic_s() - begin_s > 1.0);
  CHECK(monotonic_s() - begin_s < 3.0);
  wait_s(0.3);
  CHECK(rig.uno->state().phase == DevicePhase::ready);
}

TEST_CASE("what answers, but not as the firmware does, is refused; what does not answer is lost") {
  PluggedIn rig({}, {}, quick_boot());
  rig.board.misbehave({.refuse = true});
  CHECK(rig.uno->open().fault().code == "uno.protocol");
  CHECK(rig.uno->state().phase == DevicePhase::refused);
  rig.board.misbehave({.silent = true});
  CHECK(rig.uno->open().fault().code == "uno.silent");
  CHECK(rig.uno->state().phase == DevicePhase::lost);
  rig.board.misbehave({});
  CHECK(rig.uno->open().ok());
}
