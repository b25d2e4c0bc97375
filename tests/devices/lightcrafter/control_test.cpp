#include "devices/lightcrafter/control.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "devices/roles/clock.h"
#include "tests/devices/lightcrafter/board_reports.h"

namespace focalstage::lightcrafter {
namespace {

using lightcrafter_emulator::Board;
using lightcrafter_emulator::Misbehaviour;
using lightcrafter_emulator::Options;

LightCrafterSettings quick() {
  LightCrafterSettings settings;
  settings.answer_s = 0.2;
  settings.validate_s = 0.6;
  settings.settle_s = 0.05;
  return settings;
}

struct Bench {
  explicit Bench(Options options = {}, const LightCrafterSettings& settings = quick())
      : board(options), control(std::make_unique<BoardReports>(board, plugged), settings, hurry) {}

  PatternPlan plan() const {
    Exposures exposures;
    exposures.period_s = 1.0 / 60.0;
    exposures.form.bits = 4;
    exposures.start_s = {0.001, 0.004, 0.009};
    exposures.exposure_s = 0.002;
    return *plan_patterns(exposures, 1.0 / 60.0);
  }

  std::shared_ptr<std::atomic<bool>> plugged = std::make_shared<std::atomic<bool>>(true);
  std::atomic<bool> hurry = false;
  Board board;
  Control control;
};

TEST_CASE("ready, set up, started and dark again, with nothing refused by a strict board") {
  Bench bench;
  REQUIRE(bench.control.make_ready().ok());
  CHECK(bench.control.look()->dark());
  REQUIRE(bench.control.check_signal().ok());
  REQUIRE(bench.control.set_up(bench.plan()).ok());
  CHECK(bench.control.look()->dark());
  REQUIRE(bench.control.start().ok());
  CHECK(bench.board.running());
  CHECK(bench.board.brightness() == doctest::Approx(0.1).epsilon(0.02));
  CHECK_FALSE(bench.control.look()->dark());
  CHECK(bench.control.dark());
  CHECK(bench.control.look()->dark());
  CHECK_FALSE(bench.board.running());
  CHECK(bench.board.refusals() == 0);
  // And over again: every setting is sent while stopped.
  REQUIRE(bench.control.set_up(bench.plan()).ok());
  REQUIRE(bench.control.start().ok());
  REQUIRE(bench.control.set_up(bench.plan()).ok());
  CHECK_FALSE(bench.board.running());
  CHECK(bench.board.refusals() == 0);
}

TEST_CASE("the order that works") {
  Bench bench;
  REQUIRE(bench.control.set_up(bench.plan()).ok());
  REQUIRE(bench.control.start().ok());
  const std::vector<std::uint16_t> wanted{0x1A07, 0x1A24, 0x0200, 0x1A1B, 0x1A22, 0x1A40, 0x1A23,
                                          0x1A1D, 0x1A1E, 0x1A33, 0x1A3F, 0x1A3E, 0x1A3F, 0x1A3E,
                                          0x1A3F, 0x1A3E, 0x1A33, 0x1A1A, 0x0B01, 0x1A07, 0x1A24};
  CHECK(bench.board.history() == wanted);
}

TEST_CASE("brightness is cut to what is allowed") {
  LightCrafterSettings settings = quick();
  settings.brightness = 5.0;
  settings.most_brightness = 0.4;
  Bench bench({}, settings);
  REQUIRE(bench.control.set_up(bench.plan()).ok());
  REQUIRE(bench.control.start().ok());
  CHECK(bench.board.brightness() == doctest::Approx(0.4).epsilon(0.01));
}

TEST_CASE("a unit that wants to be started twice") {
  Options options;
  options.start_twice = true;
  Bench bench(options);
  REQUIRE(bench.control.set_up(bench.plan()).ok());
  REQUIRE(bench.control.start().ok());
  CHECK(bench.board.running());
}

TEST_CASE("a unit that never starts is dark again") {
  Bench bench;
  REQUIRE(bench.control.set_up(bench.plan()).ok());
  Misbehaviour how;
  how.never_runs = true;
  bench.board.misbehave(how);
  const Status started = bench.control.start();
  REQUIRE_FALSE(started.ok());
  CHECK(started.fault().code == "projector.start");
  CHECK(bench.control.look()->dark());
}

TEST_CASE("validations that fail, warn or never end") {
  for (const auto& [bits, strict, fails] : {std::tuple{1, false, true},
                                            {2, false, true},
                                            {4, false, false},
                                            {8, false, false},
                                            {16, false, false},
                                            {4, true, true},
                                            {8, true, true},
                                            {16, true, true}}) {
    CAPTURE(bits);
    LightCrafterSettings settings = quick();
    settings.warnings_are_faults = strict;
    Bench bench({}, settings);
    Misbehaviour how;
    how.validation_bits = static_cast<std::uint8_t>(bits);
    bench.board.misbehave(how);
    const Status done = bench.control.set_up(bench.plan());
    CHECK(done.ok() == !fails);
    if (!done) CHECK(done.fault().code == "projector.validation");
  }
  Bench bench;
  Misbehaviour how;
  how.validates_for_ever = true;
  bench.board.misbehave(how);
  const double begun_s = monotonic_s();
  const Status done = bench.control.set_up(bench.plan());
  REQUIRE_FALSE(done.ok());
  CHECK(done.fault().code == "projector.validation");
  CHECK(monotonic_s() - begun_s < 1.5);
}

TEST_CASE("every refusal is told, and the mailbox is not left open") {
  for (const int command :
       {0x1A07, 0x1A24, 0x0200, 0x1A1B, 0x1A22, 0x1A40, 0x1A23, 0x1A1D, 0x1A1E, 0x1A33, 0x1A3F, 0x1A3E, 0x1A1A}) {
    CAPTURE(command);
    Bench bench;
    Misbehaviour how;
    how.refuses = static_cast<std::uint16_t>(command);
    bench.board.misbehave(how);
    const Status done = bench.control.set_up(bench.plan());
    REQUIRE_FALSE(done.ok());
    CHECK(done.fault().code == "projector.refused");
    bench.board.misbehave({});
    CHECK(bench.control.set_up(bench.plan()).ok());
  }
}

TEST_CASE("silence, delay, rubbish and stale answers") {
  Bench bench;
  REQUIRE(bench.control.make_ready().ok());
  Misbehaviour how;
  how.silent = true;
  bench.board.misbehave(how);
  const double begun_s = monotonic_s();
  CHECK(bench.control.look().fault().code == "projector.silent");
  CHECK(monotonic_s() - begun_s < 0.4);
  // It hears, though it does not answer.
  CHECK_FALSE(bench.control.dark());
  CHECK(monotonic_s() - begun_s < 0.8);

  how = {};
  how.short_read = true;
  bench.board.misbehave(how);
  CHECK_FALSE(bench.control.look().ok());

  how = {};
  how.delay_s = 0.02;
  how.stale_first = true;
  bench.board.misbehave(how);
  CHECK(bench.control.look().ok());
  REQUIRE(bench.control.set_up(bench.plan()).ok());
  REQUIRE(bench.control.start().ok());

  // An answer that comes too late is not taken for the next one's.
  how = {};
  how.delay_s = 0.3;
  bench.board.misbehave(how);
  CHECK_FALSE(bench.control.lamp(false).ok());
  bench.board.misbehave({});
  CHECK(bench.control.look().ok());
}

TEST_CASE("sequence numbers count only where they were seen to be echoed") {
  Options options;
  options.echo_sequence = false;
  Bench silent(options);
  CHECK(silent.control.make_ready().ok());
  CHECK(silent.control.set_up(silent.plan()).ok());

  Bench bench;
  REQUIRE(bench.control.make_ready().ok());
  Misbehaviour how;
  how.wrong_sequence = true;
  bench.board.misbehave(how);
  CHECK(bench.control.lamp(true).fault().code == "projector.silent");
}

TEST_CASE("gone at any byte") {
  for (std::size_t bytes = 0; bytes < 40 * 64; bytes += 64) {
    Bench bench;
    Misbehaviour how;
    how.disconnect_after_bytes = bytes;
    bench.board.misbehave(how);
    Status done = bench.control.make_ready();
    if (done) done = bench.control.set_up(bench.plan());
    if (done) done = bench.control.start();
    if (done) continue;
    CHECK(done.fault().code == "projector.lost");
    CHECK_FALSE(bench.control.dark());
  }
}

TEST_CASE("a hurry cuts ordinary waits short, not those for darkness") {
  Bench bench;
  REQUIRE(bench.control.make_ready().ok());
  bench.hurry = true;
  CHECK(bench.control.look().fault().code == "projector.hurried");
  CHECK(bench.control.dark());
}

TEST_CASE("trouble in the hardware, light that stays on, and another video size") {
  Bench bench;
  Misbehaviour how;
  how.hardware_bits = 0x80;
  bench.board.misbehave(how);
  CHECK(bench.control.make_ready().fault().code == "projector.hardware");
  how = {};
  how.keeps_shining = true;
  bench.board.power_cycle();
  bench.board.misbehave(how);
  CHECK(bench.control.make_ready().fault().code == "projector.hardware");

  Options options;
  options.signal_width = 1280;
  options.signal_height = 800;
  Bench other(options);
  CHECK(other.control.check_signal().fault().code == "projector.no-video");
}

}  // namespace
}  // namespace focalstage::lightcrafter
