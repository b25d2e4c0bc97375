#include "devices/lightcrafter/lightcrafter.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>

#include "devices/roles/clock.h"
#include "tests/devices/lightcrafter/board_display.h"
#include "tests/devices/lightcrafter/board_reports.h"

namespace focalstage {
namespace {

using lightcrafter_emulator::Board;
using lightcrafter_emulator::Light;
using lightcrafter_emulator::Misbehaviour;

constexpr std::size_t area = 912 * 1140;

LightCrafterSettings quick() {
  LightCrafterSettings settings;
  settings.answer_s = 0.1;
  settings.poll_s = 0.02;
  return settings;
}

bool within(double seconds, const auto& condition) {
  const double until_s = monotonic_s() + seconds;
  while (!condition()) {
    if (monotonic_s() > until_s) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

Picture picture_of(std::vector<std::uint8_t> codes) {
  auto kept = std::make_shared<std::vector<std::uint8_t>>(std::move(codes));
  return {kept, *kept};
}

std::vector<std::uint8_t> ramp(int seed, int bits) {
  std::vector<std::uint8_t> codes(area);
  for (std::size_t i = 0; i < area; ++i) {
    codes[i] = static_cast<std::uint8_t>((i * 7 + static_cast<std::size_t>(seed) * 31 + i / 912) % (1U << bits));
  }
  return codes;
}

Exposures three_of_four_bits() {
  Exposures exposures;
  exposures.period_s = 1.0 / 60.0;
  exposures.form.bits = 4;
  exposures.start_s = {0.0011, 0.0041, 0.0093};
  exposures.exposure_s = 0.0021;
  return exposures;
}

struct Rig {
  explicit Rig(const LightCrafterSettings& settings = quick(), VideoMode mode = {912, 1140, 1.0 / 60.0}) {
    auto made = std::make_unique<BoardDisplay>(board, mode);
    display = made.get();
    projector = make_lightcrafter(settings, std::move(made), [this](const std::string&, const std::string&) {
      using Opened = Result<std::unique_ptr<lightcrafter::Reports>>;
      if (!*plugged) return Opened(Fault{"projector.absent", "LightCrafter 4500", "none is plugged in", "plug it in"});
      return Opened(std::make_unique<lightcrafter::BoardReports>(board, plugged));
    });
  }

  std::vector<Picture> pictures(int seed) const {
    return {picture_of(ramp(seed, 4)), picture_of(ramp(seed + 1, 4)), picture_of(ramp(seed + 2, 4))};
  }

  void run() {
    REQUIRE(projector->open().ok());
    display->vblank();
    REQUIRE(projector->arm(three_of_four_bits()).ok());
    display->vblank();
    REQUIRE(projector->start().ok());
    CHECK(projector->state().phase == DevicePhase::running);
  }

  /// Posts and waits until it is packed.
  void post(std::vector<Picture> given) {
    REQUIRE(projector->post(std::move(given)).ok());
    REQUIRE(within(2.0, [&] { return display->waiting() > 0; }));
  }

  bool lit(const std::vector<Light>& lights) const {
    return std::ranges::any_of(lights, [](const Light& light) { return !light.black(); });
  }

  std::shared_ptr<std::atomic<bool>> plugged = std::make_shared<std::atomic<bool>>(true);
  Board board;
  BoardDisplay* display = nullptr;
  std::unique_ptr<ProjectorDevice> projector;
};

TEST_CASE("light leaves when and as it was asked for") {
  Rig rig;
  rig.run();
  rig.board.take_lights();
  rig.post(rig.pictures(5));
  const double posted_s = rig.display->next_s();
  rig.display->vblank();
  rig.display->vblank();  // the board shows a frame after it has arrived
  std::vector<Light> lights = rig.board.take_lights();
  std::erase_if(lights, [](const Light& light) { return light.black(); });
  REQUIRE(lights.size() == 3);
  const Exposures asked = three_of_four_bits();
  for (std::size_t i = 0; i < 3; ++i) {
    // The vsync is the first exposure's start.
    const double wanted_s = posted_s + 1.0 / 60.0 + asked.start_s[i] - asked.start_s[0];
    CHECK(std::abs(lights[i].start_s - wanted_s) < 2e-6);
    CHECK(lights[i].length_s == doctest::Approx(asked.exposure_s).epsilon(1e-3));
    CHECK(lights[i].leds == 7);
    CHECK(lights[i].levels() == ramp(5 + static_cast<int>(i), 4));
  }
  const ProjectorReport report = rig.projector->report();
  CHECK(report.periods == 2);
  CHECK(report.exposures == 3);
  CHECK(report.missed == 3);  // nobody posted for the second
  REQUIRE(report.newest_period_s);
  CHECK(*report.newest_period_s == doctest::Approx(posted_s + 1.0 / 60.0 - asked.start_s[0]));
}

TEST_CASE("a feeder that is silent is black in the next period, and periods in the dark are not missed") {
  Rig rig;
  rig.run();
  rig.post(rig.pictures(1));
  rig.display->vblank();
  rig.board.take_lights();
  rig.display->vblank();
  CHECK(rig.lit(rig.board.take_lights()));
  rig.display->vblank();
  CHECK_FALSE(rig.lit(rig.board.take_lights()));
  const std::uint64_t missed = rig.projector->report().missed;
  rig.post({});
  rig.display->vblank();
  CHECK(rig.projector->report().missed == missed);
}

TEST_CASE("it takes two periods ahead, of the right size, and none that it is not armed for") {
  Rig rig;
  CHECK(rig.projector->post({}).fault().code == "projector.idle");
  rig.run();
  REQUIRE(rig.projector->post(rig.pictures(1)).ok());
  REQUIRE(rig.projector->post(rig.pictures(2)).ok());
  CHECK(rig.projector->post(rig.pictures(3)).fault().code == "projector.full");
  CHECK(within(2.0, [&] { return rig.display->waiting() == 2; }));
  CHECK(rig.projector->post({}).fault().code == "projector.full");
  rig.display->vblank();
  CHECK(rig.projector->post({picture_of({1, 2, 3})}).fault().code == "projector.picture");
  CHECK(rig.projector->post({}).ok());
}

TEST_CASE("dark before start, after dark, and after close") {
  Rig rig;
  REQUIRE(rig.projector->open().ok());
  REQUIRE(rig.projector->arm(three_of_four_bits()).ok());
  REQUIRE(rig.projector->post(rig.pictures(1)).ok());  // waits for the start
  for (int i = 0; i < 3; ++i) rig.display->vblank();
  CHECK(rig.board.take_lights().empty());
  REQUIRE(rig.projector->start().ok());
  CHECK(within(2.0, [&] { return rig.display->waiting() == 1; }));
  for (int i = 0; i < 2; ++i) rig.display->vblank();
  CHECK(rig.lit(rig.board.take_lights()));

  rig.post(rig.pictures(1));
  const double begun_s = monotonic_s();
  CHECK(rig.projector->dark());
  CHECK(monotonic_s() - begun_s < 0.2);
  CHECK_FALSE(rig.board.running());
  for (int i = 0; i < 3; ++i) rig.display->vblank();
  CHECK(rig.board.take_lights().empty());
  CHECK(rig.projector->state().phase == DevicePhase::ready);
  CHECK_FALSE(rig.projector->state().fault);

  REQUIRE(rig.projector->start().ok());
  rig.projector->close();
  CHECK(rig.projector->state().phase == DevicePhase::off);
  CHECK_FALSE(rig.board.running());
  for (int i = 0; i < 2; ++i) rig.display->vblank();
  CHECK(rig.board.take_lights().empty());
  CHECK(rig.projector->dark());
  CHECK(rig.projector->start().fault().code == "projector.idle");
}

TEST_CASE("dark is on time while something slow is under way") {
  Rig rig;
  rig.run();
  Misbehaviour slow;
  slow.validates_for_ever = true;
  rig.board.misbehave(slow);
  Status armed;
  std::jthread arming([&] { armed = rig.projector->arm(three_of_four_bits()); });
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  const double begun_s = monotonic_s();
  CHECK(rig.projector->dark());
  CHECK(monotonic_s() - begun_s < 0.2);
  arming.join();
  REQUIRE_FALSE(armed.ok());
  CHECK(armed.fault().code == "projector.hurried");
  rig.board.misbehave({});
  CHECK(rig.projector->arm(three_of_four_bits()).ok());
}

TEST_CASE("whoever comes first, start or dark, the board does what the phase says") {
  Rig rig;
  rig.run();
  REQUIRE(rig.projector->dark());
  for (int i = 0; i < 40; ++i) {
    {
      std::jthread starting([&] { (void)rig.projector->start(); });
      std::this_thread::sleep_for(std::chrono::microseconds(i * 50));
      (void)rig.projector->dark();
    }
    CHECK(rig.board.running() == (rig.projector->state().phase == DevicePhase::running));
    CHECK_FALSE(rig.projector->state().fault);
    (void)rig.projector->dark();
    CHECK_FALSE(rig.board.running());
  }
}

TEST_CASE("what was shown is counted from the start to the end") {
  Rig rig;
  rig.run();
  for (int i = 0; i < 3; ++i) rig.display->vblank();
  REQUIRE(rig.projector->dark());
  for (int i = 0; i < 3; ++i) rig.display->vblank();
  CHECK(rig.projector->report().periods == 3);
  CHECK(rig.projector->report().missed == 9);
  REQUIRE(rig.projector->start().ok());
  rig.display->vblank();
  CHECK(rig.projector->report().periods == 1);
}

TEST_CASE("a board that does not answer: dark says so in time, though it was heard, and the loss is named") {
  Rig rig;
  rig.run();
  Misbehaviour silent;
  silent.silent = true;
  rig.board.misbehave(silent);
  const double begun_s = monotonic_s();
  CHECK_FALSE(rig.projector->dark());
  CHECK(monotonic_s() - begun_s < 0.25);
  CHECK_FALSE(rig.board.running());
  CHECK(within(1.0, [&] { return rig.projector->state().phase == DevicePhase::lost; }));
  CHECK(rig.projector->state().fault->code == "projector.silent");
  rig.board.misbehave({});
  REQUIRE(rig.projector->open().ok());
  REQUIRE(rig.projector->arm(three_of_four_bits()).ok());
  REQUIRE(rig.projector->start().ok());
}

TEST_CASE("unplugged: lost within a second and black, and found again") {
  Rig rig;
  rig.run();
  rig.post(rig.pictures(1));
  *rig.plugged = false;
  CHECK(within(1.0, [&] { return rig.projector->state().phase == DevicePhase::lost; }));
  CHECK(rig.projector->state().fault->code == "projector.lost");
  CHECK_FALSE(rig.projector->dark());
  CHECK(rig.projector->post(rig.pictures(1)).fault().code == "projector.lost");
  rig.board.take_lights();
  for (int i = 0; i < 3; ++i) rig.display->vblank();  // the board goes on without a host
  CHECK_FALSE(rig.lit(rig.board.take_lights()));
  CHECK_FALSE(rig.projector->open().ok());
  CHECK(rig.projector->state().phase == DevicePhase::lost);
  *rig.plugged = true;
  REQUIRE(rig.projector->open().ok());
  CHECK_FALSE(rig.board.running());
  CHECK(rig.projector->state().phase == DevicePhase::ready);
}

TEST_CASE("what goes wrong by itself is named, and dark") {
  Rig rig;
  rig.run();
  rig.board.stumble();
  CHECK(within(1.0, [&] { return rig.projector->state().fault.has_value(); }));
  CHECK(rig.projector->state().fault->code == "projector.stopped");
  CHECK(rig.projector->state().phase == DevicePhase::ready);
  CHECK(rig.projector->dark());
  CHECK_FALSE(rig.projector->state().fault);
  REQUIRE(rig.projector->start().ok());

  Rig broken;
  broken.run();
  Misbehaviour how;
  how.hardware_bits = 0x40;
  broken.board.misbehave(how);
  CHECK(within(1.0, [&] { return broken.projector->state().fault.has_value(); }));
  CHECK(broken.projector->state().fault->code == "projector.hardware");
  CHECK(within(1.0, [&] { return !broken.board.running(); }));
  CHECK(broken.projector->dark());
  CHECK(within(1.0, [&] { return broken.projector->state().fault.has_value(); }));  // it still is

  Rig unplugged;
  unplugged.run();
  unplugged.display->unplug();
  CHECK(within(1.0, [&] { return unplugged.projector->state().phase == DevicePhase::lost; }));
  CHECK(unplugged.projector->state().fault->code == "display.lost");
  CHECK(within(1.0, [&] { return !unplugged.board.running(); }));
  REQUIRE(unplugged.projector->open().ok());
}

TEST_CASE("a board that goes on shining though it said yes is reported") {
  Rig rig;
  rig.run();
  Misbehaviour how;
  how.keeps_shining = true;
  rig.board.misbehave(how);
  (void)rig.projector->dark();
  CHECK(within(1.0, [&] { return rig.projector->state().fault.has_value(); }));
  CHECK(rig.projector->state().fault->code == "projector.hardware");
}

TEST_CASE("what it cannot do is refused") {
  Rig rig;
  CHECK_FALSE(rig.projector->arm(three_of_four_bits()).ok());
  REQUIRE(rig.projector->open().ok());
  CHECK(rig.projector->start().fault().code == "projector.idle");
  Exposures exposures = three_of_four_bits();
  exposures.form.bits = 8;
  CHECK(rig.projector->arm(exposures).fault().code == "projector.unable");
  const ProjectorAbilities abilities = rig.projector->abilities();
  CHECK(abilities.pacing == Pacing::master);
  CHECK(abilities.width_px == 912);

  Rig other(quick(), {1280, 800, 1.0 / 60.0});
  CHECK(other.projector->open().fault().code == "projector.unable");
  CHECK(other.projector->state().phase == DevicePhase::refused);

  Rig without;
  without.display->opens = false;
  CHECK(without.projector->open().fault().code == "display.absent");
  without.display->opens = true;
  CHECK(without.projector->open().ok());
}

TEST_CASE("identify glows a little and ends in the dark; not while running") {
  Rig rig;
  REQUIRE(rig.projector->open().ok());
  const double begun_s = monotonic_s();
  CHECK(rig.projector->identify().ok());
  CHECK(monotonic_s() - begun_s < 2.0);
  const auto history = rig.board.history();
  CHECK(std::ranges::count(history, 0x1A07) >= 6);
  CHECK(rig.board.brightness() == doctest::Approx(0.0));
  REQUIRE(rig.projector->arm(three_of_four_bits()).ok());
  REQUIRE(rig.projector->start().ok());
  CHECK_FALSE(rig.projector->identify().ok());
}

}  // namespace
}  // namespace focalstage
