#include "devices/rig/device_rig.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <doctest/doctest.h>

#include "devices/roles/clock.h"
#include "tests/devices/rig/fake_devices.h"

namespace focalstage {
namespace {

using test::Stagehands;
constexpr double period_s = Stagehands::period_s;

/// Devices that live in real time, and a player's thread.
struct Stand {
  Stagehands hands;
  std::unique_ptr<DeviceRig> rig = std::make_unique<DeviceRig>(test::devices_of(hands), DeviceRigSettings{});
  std::jthread time;

  Stand() {
    hands.now_s = monotonic_s();
    time = std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        hands.run_until(monotonic_s());
        std::this_thread::sleep_for(std::chrono::microseconds(500));
      }
    });
  }

  /// Plays for so long, or until there is a doubt.
  void play(double seconds) {
    double next_s = monotonic_s() + 6 * period_s;
    const double end_s = monotonic_s() + seconds;
    const std::vector<double> triggers{0.003, 0.006, 0.012};
    const std::vector<double> drive(400, 0.01);
    for (int sweep = 0; monotonic_s() < end_s && !rig->doubt(); ++sweep) {
      if (sweep == 0) {
        rig->set_exposure(0.0005, {});
        rig->announce_triggers(triggers);
        for (const Side eye : both_sides) rig->set_drive(eye, drive, period_s / 400);
      }
      const bool lit = sweep >= rig->settle_sweeps();
      rig->post_images(lit ? std::vector<Picture>(3, test::picture(7)) : std::vector<Picture>{});
      rig->sync_edge(next_s);
      for (const double at_s : triggers) {
        if (lit) rig->trigger(next_s + at_s);
      }
      rig->run_until(monotonic_s());
      next_s = rig->edge_near_s(next_s + period_s);
      sleep_until(next_s - 6 * period_s);
    }
    if (rig->doubt()) MESSAGE(describe(*rig->doubt()));
  }
  bool lit() {
    const std::lock_guard lock(hands.mutex);
    return hands.projector_on && hands.board_armed && hands.lens_on;
  }
  bool safe() {
    const std::lock_guard lock(hands.mutex);
    return !hands.projector_on && !hands.board_armed && !hands.lens_on;
  }
  double seconds_until_safe() {
    const double from_s = monotonic_s();
    while (!safe() && monotonic_s() < from_s + 1.0) std::this_thread::sleep_for(std::chrono::microseconds(200));
    return monotonic_s() - from_s;
  }
};

TEST_CASE("a projector that keeps its own time is refused, and nothing is given out") {
  Stand stand;
  {
    const std::lock_guard lock(stand.hands.mutex);
    stand.hands.pacing = Pacing::master;
  }
  const Status ready = stand.rig->ready();
  REQUIRE(!ready);
  CHECK(ready.fault().where == "projector");
  CHECK(stand.safe());
}

TEST_CASE("lights, and is dark on every device within 50 ms of being told") {
  Stand stand;
  REQUIRE(stand.rig->ready());
  stand.play(1.6);
  CHECK(stand.lit());
  CHECK(!stand.hands.shown.empty());
  stand.rig->dark(monotonic_s());
  CHECK(stand.seconds_until_safe() < 0.05);
  // And lights again.
  while (!stand.rig->ready()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  stand.play(1.6);
  CHECK(stand.lit());
}

TEST_CASE("the lenses go to rest once the light is out, or where that takes too long") {
  Stand stand;
  stand.hands.projector_darkens_ms = 15;
  stand.play(1.6);
  REQUIRE(stand.lit());
  stand.rig->dark(monotonic_s());
  CHECK(stand.seconds_until_safe() < 0.05);
  CHECK(stand.hands.lens_stops_in_light == 0);

  stand.hands.projector_darkens_ms = 300;
  while (!stand.rig->ready()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  stand.play(1.6);
  REQUIRE(stand.lit());
  const double from_s = monotonic_s();
  stand.rig->dark(from_s);
  const auto driven = [&] {
    const std::lock_guard lock(stand.hands.mutex);
    return stand.hands.lens_on;
  };
  while (driven() && monotonic_s() < from_s + 1.0) std::this_thread::sleep_for(std::chrono::microseconds(200));
  CHECK(monotonic_s() - from_s < 0.05);
  stand.hands.projector_darkens_ms = 0;
}

TEST_CASE("a device that is lost makes all of them dark, and is named") {
  Stand stand;
  stand.play(1.4);
  REQUIRE(stand.lit());
  {
    const std::lock_guard lock(stand.hands.mutex);
    stand.hands.board_state = {DevicePhase::lost, Fault{"board.gone", "/dev/ttyACM0", "it was unplugged", ""}, 0.0, {}};
  }
  CHECK(stand.seconds_until_safe() < 0.05);
  const auto doubt = stand.rig->doubt();
  REQUIRE(doubt);
  CHECK(doubt->where == "trigger board (here)");
  CHECK(doubt->message == "it was unplugged");
  CHECK(!stand.rig->ready());
  {
    const std::lock_guard lock(stand.hands.mutex);
    stand.hands.board_state = {DevicePhase::ready, {}, 0.0, {}};
  }
  CHECK(stand.rig->ready());
  CHECK(!stand.rig->doubt());
}

TEST_CASE("told to be dark at any moment of its beginning, it stays dark") {
  for (int ms = 0; ms < 500; ms += 41) {
    Stand stand;
    std::jthread player([&] { stand.play(0.001 * ms + 0.3); });
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
    stand.rig->dark(monotonic_s());
    player.request_stop();
    player.join();
    stand.rig->dark(monotonic_s());
    stand.seconds_until_safe();
    for (int look = 0; look < 20; ++look) {
      CHECK(stand.safe());
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
}

}  // namespace
}  // namespace focalstage
