#include <cmath>
#include <numbers>
#include <thread>

#include <doctest/doctest.h>

#include "devices/roles/detection.h"
#include "devices/runtime/rig_thread.h"
#include "tests/devices/runtime/sample_project.h"
#include "tests/devices/sample_show.h"

// The simulator can fail: for each fault that nobody was told of, the slots that fail are derived here by hand from the
// sweep P(t) = -2 cos(2 pi 60 t) dioptres, and exactly those must.

namespace focalstage {
namespace {

class NoiseFrames : public FrameSource {
 public:
  explicit NoiseFrames(ShowHeader header) : header_(std::move(header)) {}
  Result<FrameImages> frame(int frame) override { return sample::noise(header_, static_cast<std::uint64_t>(frame)); }

 private:
  ShowHeader header_;
};

std::shared_ptr<LoadedShow> show_of(const Project& project) {
  const ShowHeader header = sample::header_of(project);
  return sample::loaded(header, std::make_unique<NoiseFrames>(header));
}

/// Plays in virtual time and waits until the sweeps are over.
RigState played(const SimFaults& faults, std::uint64_t sweeps, Project project = sample::project()) {
  project.frames.count = 3;
  RigThreadSettings settings;
  settings.rig = simulated_rig(sample::sim(), faults);
  settings.clock = RigClock::virtual_time;
  RigThread rig(settings);
  REQUIRE(rig.activate(show_of(project)));
  REQUIRE(rig.play(sweeps));
  while (rig.state().state == "playing") std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return rig.state();
}

double asked_d(double time_s) { return -2.0 * std::cos(2.0 * std::numbers::pi * 60.0 * time_s); }

/// Slot times of P = -1, -0.1, 0.4, 1 rising and falling: t = arccos(-P/2) / (2 pi 60), and 1/60 - t.
std::vector<double> centres_s() {
  std::vector<double> times;
  for (const double power_d : {-1.0, -0.1, 0.4, 1.0}) {
    times.push_back(std::acos(-power_d / 2.0) / (2.0 * std::numbers::pi * 60.0));
  }
  for (const double power_d : {1.0, 0.4, -0.1, -1.0}) {
    times.push_back(1.0 / 60.0 - std::acos(-power_d / 2.0) / (2.0 * std::numbers::pi * 60.0));
  }
  return times;
}

std::vector<bool> delivered(const RigState& state) {
  std::vector<bool> result;
  for (const SlotReport& slot : state.slots) result.push_back(slot.delivered);
  return result;
}

TEST_CASE("without a fault every slot is delivered, to far within the tolerance") {
  const RigState state = played({}, 120);
  REQUIRE(state.slots.size() == 8);
  CHECK(state.missed_exposures == 0);
  CHECK(state.late_sweeps == 0);
  CHECK(state.fault.empty());
  const std::vector<double> centres = centres_s();
  for (std::size_t i = 0; i < 8; ++i) {
    const SlotReport& slot = state.slots[i];
    CAPTURE(i);
    CHECK(slot.delivered);
    CHECK(slot.exposures == 120);
    CHECK(slot.asked_s + 0.00025 == doctest::Approx(centres[i]).epsilon(1e-9));
    CHECK(std::abs(slot.delivered_power_d - slot.asked_power_d) < 1e-4);
    CHECK(std::abs(slot.delivered_s - slot.asked_s) < 1e-9);
    CHECK(slot.eye == (i < 4 ? 0 : 1));
    CHECK(slot.right_image);
    CHECK(slot.own_shutter_open);
    CHECK(slot.other_shutter_closed);
  }
}

TEST_CASE("1 ms more lag: every slot has the power of 1 ms ago") {
  SimFaults faults;
  faults.lens_lag_s = 0.001;
  const RigState state = played(faults, 20);
  const std::vector<double> centres = centres_s();
  REQUIRE(state.slots.size() == 8);
  for (std::size_t i = 0; i < 8; ++i) {
    CAPTURE(i);
    const double expected_d = asked_d(centres[i] - 0.001);
    CHECK(state.slots[i].delivered_power_d == doctest::Approx(expected_d).epsilon(1e-3));
    // Off by 0.43 to 0.75 D: all of them fail, by their power alone.
    CHECK(std::abs(expected_d - state.slots[i].asked_power_d) > 0.4);
    CHECK_FALSE(state.slots[i].delivered);
    CHECK(state.slots[i].right_image);
    CHECK(state.slots[i].own_shutter_open);
  }
}

TEST_CASE("10 % less gain: the slots beyond 0.2 D fail, those at -0.1 D do not") {
  SimFaults faults;
  faults.lens_gain = 0.9;
  const RigState state = played(faults, 20);
  CHECK(delivered(state) == std::vector{false, true, false, false, false, false, true, false});
  CHECK(state.slots[0].delivered_power_d == doctest::Approx(-0.9).epsilon(1e-4));
}

TEST_CASE("a lost trigger: its slot is missed, those after it in the sweep show the image before theirs") {
  for (const std::uint64_t lost : {0u, 3u, 7u}) {
    SimFaults faults;
    faults.drop_trigger = 8 * 5 + lost;  // in the sixth lit sweep
    const RigState state = played(faults, 20);
    CAPTURE(lost);
    REQUIRE(state.slots.size() == 8);
    for (std::size_t i = 0; i < 8; ++i) {
      CAPTURE(i);
      CHECK(state.slots[i].delivered == (i < lost));
      CHECK(state.slots[i].missed == (i == lost ? 1 : 0));
      // Six sweeps, and those until it must be dark: one in which it is noticed, one more.
      const double period_s = 1.0 / 60.0;
      const auto shown = 6 + std::lround(dark_within_s(Doubt::late_frame, period_s) / period_s);
      CHECK(state.slots[i].exposures == static_cast<std::uint64_t>(i == lost ? shown - 1 : shown));
      CHECK(state.slots[i].right_image == (i <= lost));
    }
    CHECK(state.missed_exposures == 1);
    CHECK(state.state == "dark");
    CHECK(state.fault.find("rig.missed-light") != std::string::npos);
  }
}

TEST_CASE("a shutter 2 ms late: the slots fail that begin before it is open") {
  // The left shutter is told at -1.5 ms and clear at 1.5 ms; late, at 3.5 ms. Of the left slots only the first, at
  // -1 D from 2.53 ms on, begins before. It closes by 7.33 + 1.6 = 8.93 ms, within the dead window.
  SimFaults left;
  left.shutter_late_s.left = 0.002;
  const RigState left_late = played(left, 20);
  CHECK(delivered(left_late) == std::vector{false, true, true, true, true, true, true, true});
  CHECK_FALSE(left_late.slots[0].own_shutter_open);
  CHECK(left_late.slots[0].other_shutter_closed);
  CHECK(left_late.slots[0].right_image);
  // The right one, told at 6.83 ms, is clear at 11.83 ms; its slots at +1 D and +0.4 D begin at 10.86 and 11.72 ms, the
  // next at 12.38 ms.
  SimFaults right;
  right.shutter_late_s.right = 0.002;
  const RigState right_late = played(right, 20);
  CHECK(delivered(right_late) == std::vector{true, true, true, true, false, false, true, true});
  CHECK_FALSE(right_late.slots[4].own_shutter_open);
}

TEST_CASE("a shutter so late that it stays open into the other eye's light is seen there") {
  SimFaults faults;
  faults.shutter_late_s.left = 0.006;
  const RigState state = played(faults, 20);
  // Closed at 6.83 + 6.1 = 12.93 ms: the right slots at +1, +0.4 and -0.1 D (from 10.86, 11.72 and 12.38 ms on) are
  // also seen by the left eye, the one at -1 D (from 13.64 ms on) is not.
  CHECK_FALSE(state.slots[4].other_shutter_closed);
  CHECK_FALSE(state.slots[5].other_shutter_closed);
  CHECK_FALSE(state.slots[6].other_shutter_closed);
  CHECK(state.slots[7].other_shutter_closed);
  CHECK(state.slots[4].own_shutter_open);
  CHECK_FALSE(state.slots[4].delivered);
}

TEST_CASE("a light image that both eyes share is delivered to both") {
  Project project = sample::project();
  project.surfaces[0].illumination = 0.5;
  project.slices.powers_d = {-1.0, 1.0};
  const RigState state = played({}, 20, project);
  REQUIRE(state.slots.size() == 6);
  for (const SlotReport& slot : state.slots) CHECK(slot.delivered);
  CHECK(state.slots[1].asked_power_d == doctest::Approx(0.0));
  CHECK(state.slots[1].image == state.slots[4].image);
  CHECK(state.slots[1].eye == 0);
  CHECK(state.slots[4].eye == 1);
}

TEST_CASE("a projector that leads by more than the dead window: triggers before their sweep begins") {
  // 4 ms of latency: the first slot (2.53 ms) is triggered at -1.47 ms.
  Project project = sample::project();
  project.projectors[0].latency_ms = 4.0;
  project.frames.count = 3;
  RigThreadSettings settings;
  SimSettings sim = sample::sim();
  sim.projector.latency_s = 0.004;
  settings.rig = simulated_rig(sim);
  settings.clock = RigClock::virtual_time;
  RigThread rig(settings);
  REQUIRE(rig.activate(show_of(project)));
  for (int round = 0; round < 3; ++round) {
    REQUIRE(rig.play(7));
    while (rig.state().state == "playing") std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const RigState state = rig.state();
  for (const SlotReport& slot : state.slots) {
    CHECK(slot.delivered);
    CHECK(slot.exposures == 21);
  }
}

TEST_CASE("virtual time gives the same report each time, to the last bit") {
  SimFaults faults;
  faults.drop_trigger = 77;
  faults.lens_gain = 0.999;
  CHECK(played(faults, 50).slots == played(faults, 50).slots);
}

TEST_CASE("missed light ends in latched darkness") {
  RigThreadSettings settings;
  SimSettings sim = sample::sim();
  sim.projector.least_frame_s = 0.0006;  // some slots follow each other faster than this projector can
  settings.rig = simulated_rig(sim);
  settings.clock = RigClock::virtual_time;
  Project project = sample::project();
  project.slices.powers_d = {-0.2, 0.2};  // 0.53 ms apart at 754 D/s
  RigThread rig(settings);
  REQUIRE(rig.activate(show_of(project)));
  REQUIRE(rig.play(100));
  while (rig.state().state == "playing") std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const RigState state = rig.state();
  CHECK(state.state == "dark");
  CHECK(state.fault.find("rig.missed-light") != std::string::npos);
  CHECK(state.sweeps < 6);
  CHECK(rig.play(1).fault().code == "rig.refused");
  REQUIRE(rig.go());
  CHECK(rig.state().state == "ready");
  CHECK(rig.state().fault.empty());
}

}  // namespace
}  // namespace focalstage
