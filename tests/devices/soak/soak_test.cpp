#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include <doctest/doctest.h>

#include "devices/runtime/rig_thread.h"
#include "tests/devices/runtime/sample_project.h"
#include "tests/devices/sample_show.h"

#ifdef __SANITIZE_ADDRESS__
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();  // in allocator_interface.h, which GCC leaves out
#endif

// A gallery's day in virtual time. FOCALSTAGE_SOAK_HOURS says how long; a few minutes of show where it does not.

namespace focalstage {
namespace {

class NoiseFrames : public FrameSource {
 public:
  explicit NoiseFrames(ShowHeader header) : header_(std::move(header)) {}
  Result<FrameImages> frame(int frame) override { return sample::noise(header_, static_cast<std::uint64_t>(frame)); }

 private:
  ShowHeader header_;
};

double hours() {
  const char* asked = std::getenv("FOCALSTAGE_SOAK_HOURS");
  return asked != nullptr ? std::atof(asked) : 0.1;
}

/// What this program holds in memory now. The address sanitizer keeps what was given back: there, what is in use.
double held_mib() {
#ifdef __SANITIZE_ADDRESS__
  return static_cast<double>(__sanitizer_get_current_allocated_bytes()) / (1024.0 * 1024.0);
#else
  std::ifstream status("/proc/self/statm");
  double total = 0.0;
  double resident = 0.0;
  status >> total >> resident;
  return resident * 4096.0 / (1024.0 * 1024.0);
#endif
}

TEST_CASE("a day of sweeps: none lost, none off, none of memory's") {
  Project project = sample::project(16, 12);
  project.frames.count = 4;
  const ShowHeader header = sample::header_of(project);
  RigThreadSettings settings;
  settings.rig = simulated_rig(sample::sim(16, 12));
  settings.clock = RigClock::virtual_time;
  RigThread rig(settings);
  REQUIRE(rig.activate(sample::loaded(header, std::make_unique<NoiseFrames>(header))));
  const auto sweeps = static_cast<std::uint64_t>(hours() * 3600.0 * 60.0);
  const std::uint64_t warm_up = std::min<std::uint64_t>(3600, sweeps / 4);
  REQUIRE(rig.play(sweeps));
  const auto started = std::chrono::steady_clock::now();
  double warm_mib = 0.0;
  RigState state;
  do {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    state = rig.state();
    if (warm_mib == 0.0 && state.sweeps >= warm_up) warm_mib = held_mib();
  } while (state.state == "playing");
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;

  CHECK(state.fault.empty());
  CHECK(state.missed_exposures == 0);
  CHECK(state.late_sweeps == 0);
  double worst_s = 0.0;
  double worst_d = 0.0;
  for (const SlotReport& slot : state.slots) {
    CHECK(slot.delivered);
    CHECK(slot.exposures == sweeps);
    worst_s = std::max(worst_s, std::abs(slot.delivered_s - slot.asked_s));
    worst_d = std::max(worst_d, std::abs(slot.delivered_power_d - slot.asked_power_d));
  }
  // The worst of all sweeps is kept: a drift would be in it.
  CHECK(worst_s < 1e-9);
  const double grown_mib = held_mib() - warm_mib;
  CHECK(grown_mib < 8.0);
  std::printf("%llu sweeps (%.2f h) in %.1f s; worst %.3g us, %.3g D off; memory grew by %.2f MiB\n",
              static_cast<unsigned long long>(sweeps), hours(), took.count(), worst_s * 1e6, worst_d, grown_mib);
}

}  // namespace
}  // namespace focalstage
