#include <doctest/doctest.h>
#include <umockdev.h>

#include <algorithm>
#include <thread>

#include "devices/lightcrafter/control.h"
#include "devices/lightcrafter/identify.h"
#include "devices/lightcrafter/lightcrafter.h"
#include "devices/lightcrafter/probe.h"
#include "devices/roles/clock.h"
#include "tests/devices/lightcrafter/board_display.h"
#include "tests/devices/lightcrafter/emulator/hidraw_host.h"

namespace focalstage {
namespace {

using lightcrafter_emulator::Board;
using lightcrafter_emulator::HidrawHost;

bool within(double seconds, const auto& condition) {
  const double until_s = monotonic_s() + seconds;
  while (!condition()) {
    if (monotonic_s() > until_s) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

struct Usb {
  Usb() : bed(umockdev_testbed_new()) {}
  ~Usb() { g_object_unref(bed); }
  UMockdevTestbed* bed;
};

TEST_CASE("over hidapi: found, told, unplugged and found again on another node") {
  Usb usb;
  CHECK(probe_lightcrafter().empty());
  CHECK(lightcrafter::open_hid("", "").fault().code == "projector.absent");
  Board board;
  const auto host = HidrawHost::start(usb.bed, board, "LCR4-17", 3);
  const auto found = probe_lightcrafter();
  REQUIRE(found.size() == 1);
  CHECK(found[0] == DeviceId{"lightcrafter", "LightCrafter 4500", "LCR4-17", "/dev/hidraw3"});
  CHECK(lightcrafter::open_hid("another", "").fault().code == "projector.absent");

  LightCrafterSettings settings;
  settings.serial = "LCR4-17";
  settings.poll_s = 0.05;
  auto made = std::make_unique<BoardDisplay>(board);
  BoardDisplay& display = *made;
  const auto projector = make_lightcrafter(settings, std::move(made));
  REQUIRE(projector->open().ok());
  CHECK(projector->id().serial == "LCR4-17");
  CHECK(identify_lightcrafter("LCR4-17").fault().code == "projector.busy");
  Exposures exposures;
  exposures.period_s = 1.0 / 60.0;
  exposures.form.bits = 1;
  for (int i = 0; i < 20; ++i) exposures.start_s.push_back(i * 0.0008);
  exposures.exposure_s = 0.0004;
  REQUIRE(projector->arm(exposures).ok());
  REQUIRE(projector->start().ok());
  CHECK(board.running());
  CHECK(board.refusals() == 0);
  display.vblank();

  const double pulled_s = monotonic_s();
  host->unplug();
  CHECK(within(1.0, [&] { return projector->state().phase == DevicePhase::lost; }));
  MESSAGE("lost " << (monotonic_s() - pulled_s) * 1e3 << " ms after it was pulled");
  CHECK(probe_lightcrafter().empty());
  CHECK_FALSE(projector->open().ok());

  host->plug();
  CHECK(host->node() == "/dev/hidraw4");
  REQUIRE(projector->open().ok());
  CHECK(projector->id().address == "/dev/hidraw4");
  CHECK_FALSE(board.running());
  REQUIRE(projector->arm(exposures).ok());
  REQUIRE(projector->start().ok());
  projector->close();
  CHECK_FALSE(board.running());
}

TEST_CASE("over hidapi: round trips") {
  Usb usb;
  Board board;
  const auto host = HidrawHost::start(usb.bed, board);
  auto reports = lightcrafter::open_hid("", "");
  REQUIRE(reports.ok());
  const std::atomic<bool> hurry = false;
  lightcrafter::Link link(std::move(*reports), 0.5, hurry);
  const double begun_s = monotonic_s();
  for (int i = 0; i < 300; ++i) {
    const auto led = static_cast<std::uint8_t>(i % 16);
    REQUIRE(link.write(lightcrafter::Command::led_enable, std::span(&led, 1)).ok());
    const auto read = link.read(lightcrafter::Command::led_enable);
    REQUIRE(read.ok());
    REQUIRE(read->front() == led);
  }
  const double each_us = (monotonic_s() - begun_s) / 600 * 1e6;
  MESSAGE(each_us << " us per round trip");
  // A message of several reports has one answer.
  REQUIRE(link.write(lightcrafter::Command::mailbox_control, std::array<std::uint8_t, 1>{2}).ok());
  REQUIRE(link.write(lightcrafter::Command::mailbox_data, lightcrafter::Bytes(72, 0x71)).ok());
  CHECK(board.refusals() == 0);
}

TEST_CASE("it glows to be found, without a video output, and is dark afterwards") {
  Usb usb;
  CHECK(identify_lightcrafter("").fault().code == "projector.absent");
  Board board;
  const auto host = HidrawHost::start(usb.bed, board, "LCR4-18");
  REQUIRE(identify_lightcrafter("LCR4-18").ok());
  CHECK_FALSE(board.running());
  const auto history = board.history();
  constexpr std::uint16_t led_enable = 0x1A07;
  CHECK(std::ranges::count(history, led_enable) >= 6);
  CHECK(identify_lightcrafter("LCR4-18").ok());  // it was given back
}

}  // namespace
}  // namespace focalstage
