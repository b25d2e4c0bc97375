#include "devices/input/spacemouse.h"

#include <atomic>
#include <functional>
#include <thread>

#include <doctest/doctest.h>
#include <umockdev.h>

#include "devices/input/motion_watch.h"
#include "devices/input/probe.h"
#include "devices/roles/clock.h"
#include "tests/devices/input/emulator/spacemouse_host.h"

namespace focalstage {
namespace {

using spacemouse_emulator::Hand;
using spacemouse_emulator::SpaceMouseHost;
using spacemouse_emulator::SpaceMouseKind;

bool within(double seconds, const std::function<bool()>& holds) {
  for (const double end_s = monotonic_s() + seconds; monotonic_s() < end_s;) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return holds();
}

struct Usb {
  Usb() : bed(umockdev_testbed_new()) {}
  ~Usb() { g_object_unref(bed); }
  UMockdevTestbed* bed;
};

TEST_CASE("found, held, let go, pressed") {
  for (const bool combined : {false, true}) {
    CAPTURE(combined);
    Usb usb;
    CHECK(probe_spacemouse().empty());
    SpaceMouseKind kind;
    kind.combined = combined;
    const auto host = SpaceMouseHost::start(usb.bed, kind, 3);
    REQUIRE(probe_spacemouse().size() == 1);
    CHECK(probe_spacemouse()[0] == DeviceId{"input", "SpaceMouse Compact", "SM-1", "/dev/hidraw3"});
    const auto mouse = make_spacemouse();
    REQUIRE(mouse->open().ok());
    CHECK(mouse->deflection() == Deflection{});
    host->hold({{179, 0, 0, 0, 0, -350}});
    CHECK(within(3.0, [&] { return mouse->deflection() == Deflection{{0.5, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0}; }));
    host->let_go();
    CHECK(within(3.0, [&] { return mouse->deflection() == Deflection{}; }));
    host->press(2);
    CHECK(within(3.0, [&] { return mouse->deflection().buttons == 2; }));
    const std::uint8_t battery[] = {0x17, 90};
    host->send(battery);
    CHECK(mouse->state().phase == DevicePhase::ready);
  }
}

TEST_CASE("the last report of a motion is lost: it ends all the same") {
  Usb usb;
  const auto host = SpaceMouseHost::start(usb.bed, {});
  const auto mouse = make_spacemouse();
  REQUIRE(mouse->open().ok());
  host->hold({{0, 350, 0, 0, 0, 0}});
  REQUIRE(within(3.0, [&] { return mouse->deflection().push.z == 1.0; }));
  host->let_go(false);
  CHECK(within(1.0, [&] { return mouse->deflection() == Deflection{}; }));
}

TEST_CASE("unplugged while it is held: no push, lost, and found again on another node") {
  Usb usb;
  const auto host = SpaceMouseHost::start(usb.bed, {});
  SpaceMouseSettings settings;
  settings.serial = "SM-1";
  const auto mouse = make_spacemouse(settings);
  REQUIRE(mouse->open().ok());
  host->hold({{350, 0, 0, 0, 0, 0}});
  REQUIRE(within(3.0, [&] { return mouse->deflection().push.x == 1.0; }));
  host->unplug();
  CHECK(within(3.0, [&] { return mouse->state().phase == DevicePhase::lost; }));
  CHECK(mouse->deflection() == Deflection{});
  CHECK(mouse->state().fault->code == "input.lost");
  CHECK(mouse->open().fault().code == "input.absent");
  host->plug();
  REQUIRE(mouse->open().ok());
  CHECK(mouse->id().address == host->node());
  CHECK(within(3.0, [&] { return mouse->deflection().push.x == 1.0; }));
  settings.serial = "another";
  CHECK(make_spacemouse(settings)->open().fault().code == "input.absent");
}

TEST_CASE("it shows itself by its lamp, which is on again afterwards") {
  Usb usb;
  const auto host = SpaceMouseHost::start(usb.bed, {});
  const auto mouse = make_spacemouse();
  CHECK_FALSE(mouse->identify().ok());
  REQUIRE(mouse->open().ok());
  REQUIRE(mouse->identify().ok());
  CHECK(within(5.0, [&] { return host->lamp().size() == 6; }));
  CHECK(host->lamp() == std::vector<bool>{false, true, false, true, false, true});
}

TEST_CASE("a watch finds it whenever it is plugged in, and wakes whoever waits") {
  Usb usb;
  std::atomic<int> woken = 0;
  const MotionWatch watch(
      make_spacemouse(), [&] { ++woken; }, 0.05);
  CHECK_FALSE(watch.present());
  const auto host = SpaceMouseHost::start(usb.bed, {});
  CHECK(within(3.0, [&] { return watch.present() && woken > 0; }));
  woken = 0;
  host->hold({{0, 0, -350, 0, 0, 0}});
  CHECK(within(3.0, [&] { return watch.deflection().push.y == 1.0 && woken > 0; }));
  host->unplug();
  CHECK(within(3.0, [&] { return !watch.present() && watch.deflection() == Deflection{}; }));
  host->plug();
  CHECK(within(3.0, [&] { return watch.present(); }));
}

}  // namespace
}  // namespace focalstage
