#include <chrono>
#include <cstdio>
#include <thread>

#include <doctest/doctest.h>

#include "devices/runtime/rig_thread.h"
#include "devices/runtime/show_loader.h"
#include "devices/runtime/sim_description.h"
#include "tests/devices/runtime/sample_project.h"

namespace focalstage {
namespace {

TEST_CASE("five seconds in real time: every image shown is the right one, in its place") {
  const sample::Folder folder;
  const auto path = folder.path() / "show.h5";
  Project project = sample::project(1024, 768);
  project.frames.count = 20;
  REQUIRE(sample::write_show(path, project));
  RigThreadSettings settings;
  const auto rig_at = [&](double hz) { return settings.rig.describe(settings.limits, hz); };
  const auto show = load_show(path, std::string(64, 'a'), {rig_at, settings.limits});
  REQUIRE(show);
  RigThread rig(settings);
  REQUIRE(rig.activate(*show));
  const auto started = std::chrono::steady_clock::now();
  REQUIRE(rig.play(300));
  while (rig.state().state == "playing") std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
  const RigState state = rig.state();

  std::printf(
      "%llu sweeps in %.3f s, %llu late, %llu exposures missed%s%s\n", static_cast<unsigned long long>(state.sweeps),
      took.count(), static_cast<unsigned long long>(state.late_sweeps),
      static_cast<unsigned long long>(state.missed_exposures), state.fault.empty() ? "" : "; ", state.fault.c_str());
  for (const LatenessBin& bin : state.lateness) {
    std::printf("  handed over up to %7.0f us after the plan: %llu\n", bin.up_to_us,
                static_cast<unsigned long long>(bin.sweeps));
  }
  // How late this machine is, is not ours to assert; that what is shown is right, is.
  for (const SlotReport& slot : state.slots) {
    if (slot.exposures == 0) continue;
    CHECK(slot.right_image);
    CHECK(slot.own_shutter_open);
    CHECK(slot.other_shutter_closed);
    CHECK(std::abs(slot.delivered_power_d - slot.asked_power_d) < 0.02);
    CHECK(std::abs(slot.delivered_s - slot.asked_s) < 20e-6);
  }
  rig.blackout();
}

}  // namespace
}  // namespace focalstage
