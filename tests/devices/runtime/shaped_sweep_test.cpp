#include <algorithm>
#include <cmath>
#include <filesystem>
#include <thread>

#include <doctest/doctest.h>

#include "core/check/rig_differences.h"
#include "core/schedule/sweep_shape.h"
#include "devices/runtime/admission.h"
#include "devices/runtime/rig_thread.h"
#include "tests/devices/runtime/sample_project.h"
#include "tests/devices/sample_show.h"

// Every sample with its sine and with its shaped sweep, played on the simulated rig: what its lenses did, who know
// nothing of slices, beside what was asked.

namespace focalstage {
namespace {

class GrayFrames : public FrameSource {
 public:
  explicit GrayFrames(ShowHeader header) : header_(std::move(header)) {}
  Result<FrameImages> frame(int frame) override { return sample::noise(header_, static_cast<std::uint64_t>(frame)); }

 private:
  ShowHeader header_;
};

/// The sample of that name on the simulated rig: with the lenses that it measured of itself, and small images.
Project adopted(const std::string& name) {
  const auto folder = std::filesystem::path(FOCALSTAGE_SOURCE_DIR) / "projects" / name;
  const Result<LoadedProject> loaded = load_project(folder);
  REQUIRE(loaded.ok());
  Project project = loaded->project;
  project.glasses.lens_response = describe_sim(sample::sim(), {}, 60.0).glasses.lens_response;
  project.frames = {1, 60.0, {}};
  project.projectors[0].width_px = sample::sim().width_px;
  project.projectors[0].height_px = sample::sim().height_px;
  return project;
}

RigState played(const Project& project) {
  const ShowHeader header = sample::header_of(project);
  RigThreadSettings settings;
  settings.rig = simulated_rig(sample::sim());
  settings.clock = RigClock::virtual_time;
  RigThread rig(settings);
  REQUIRE(rig.activate(sample::loaded(header, std::make_unique<GrayFrames>(header))));
  REQUIRE(rig.play(20));
  while (rig.state().state == "playing") std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return rig.state();
}

/// All slots as asked, within the rules of delivery; the worst smear that the lenses had.
double delivered_smear_d(const Project& project) {
  const RigState state = played(project);
  const bool lit = image_plan(project).back().slice < 0;  // the light has exposures of its own
  REQUIRE(state.slots.size() == 2 * (project.slices.powers_d.size() + (lit ? 1 : 0)));
  double worst_d = 0.0;
  for (const SlotReport& slot : state.slots) {
    CHECK(slot.delivered);
    CHECK(slot.exposures == 20);
    CHECK(std::abs(slot.delivered_power_d - slot.asked_power_d) < 0.02);
    CHECK(std::abs(slot.delivered_s - slot.asked_s) < 20e-6);
    CHECK(slot.delivered_smear_d == doctest::Approx(slot.asked_smear_d).epsilon(0.02).scale(0.1));
    worst_d = std::max(worst_d, slot.delivered_smear_d);
  }
  return worst_d;
}

}  // namespace

TEST_CASE("on the simulated rig a shaped sweep smears at most half as much as the sine") {
  for (const char* name : {"first-light", "three-rabbits", "depth-matching", "moving-plane", "slanted-checker",
                           "step-teapot", "corner-cuboids"}) {
    CAPTURE(name);
    const Project sine = adopted(name);
    const Result<SweepShape> shape = shape_sweep(sine, image_plan(sine));
    REQUIRE(shape.ok());
    REQUIRE(shape->better);
    Project shaped = sine;
    for (const Side eye : both_sides) shaped.sweep.waveform[eye] = shape->waveform[eye];
    RigDescription rig = describe_sim(sample::sim(), {}, 60.0);
    CHECK(fits_rig(sample::header_of(shaped), shaped, rig).ok());
    CHECK(2.0 * delivered_smear_d(shaped) <= delivered_smear_d(sine));
  }
}

TEST_CASE("a sweep shaped with a response that is not the lens's is refused") {
  Project project = adopted("three-rabbits");
  for (const Side eye : both_sides) {
    for (LensHarmonic& entry : project.glasses.lens_response[eye]) {
      if (entry.harmonic > 2) entry.gain_d_per_a = 40.0;
    }
  }
  const Result<SweepShape> shape = shape_sweep(project, image_plan(project));
  REQUIRE(shape.ok());
  REQUIRE(shape->better);
  for (const Side eye : both_sides) project.sweep.waveform[eye] = shape->waveform[eye];
  const Status fits = fits_rig(sample::header_of(project), project, describe_sim(sample::sim(), {}, 60.0));
  REQUIRE_FALSE(fits.ok());
  CHECK(fits.fault().code == "rig.differs");
}

}  // namespace focalstage
