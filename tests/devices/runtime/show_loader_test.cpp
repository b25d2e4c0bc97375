#include "devices/runtime/show_loader.h"

#include <doctest/doctest.h>

#include "tests/devices/runtime/sample_project.h"

namespace focalstage {
namespace {

RigDescription rig_at(double frequency_hz) { return describe_sim(sample::sim(), {}, frequency_hz); }

Result<std::shared_ptr<const LoadedShow>> load(const Project& project, const RigLimits& limits = {}) {
  const sample::Folder folder;
  const auto path = folder.path() / "show.h5";
  REQUIRE(sample::write_show(path, project));
  return load_show(path, std::string(64, 'a'), {rig_at, limits});
}

bool names(const Fault& fault, const std::string& word) { return fault.message.find(word) != std::string::npos; }

TEST_CASE("a show made for the rig is taken, with its own images") {
  Project project = sample::project();
  project.frames.count = 2;
  const auto show = load(project);
  REQUIRE(show);
  CHECK((*show)->plan.trigger_s.size() == 8);
  const auto frame = (*show)->frames->wait_for(1);
  REQUIRE(frame);
  CHECK((*frame)->codes == sample::noise((*show)->header, 1001).codes);
}

TEST_CASE("a show made for the rig at another frequency is held against the lens at that frequency") {
  Project project = sample::project();
  project.sweep.frequency_hz = 75.0;
  project.frames.rate_hz = 75.0;
  project.slices.powers_d = {-0.5, 0.5};
  project.projectors[0].frames_per_second = 2500.0;
  CHECK(load(project).fault().code == "rig.differs");  // it carries the response at 60 Hz
  project.glasses.lens_response = rig_at(75.0).glasses.lens_response;
  CHECK(load(project));
}

TEST_CASE("a lens off by more than 0.02 D is refused, one off by less is not") {
  // Harmonic 1 of the sweep has 2 D: 0.9 % of gain are 0.018 D, 1.1 % are 0.022 D; at a slice the drive misses less.
  for (const double change : {1.009, 1.011}) {
    Project project = sample::project();
    project.glasses.lens_response.left[1].gain_d_per_a *= change;
    const auto show = load(project);
    CHECK(show.ok() == (change < 1.01));
    if (show.ok()) continue;
    CHECK(show.fault().code == "rig.differs");
    CHECK(show.fault().remedy.find("adopt-rig") != std::string::npos);
  }
}

TEST_CASE("times off by more than 20 us, and other sizes, are refused; the message says which") {
  Project project = sample::project();
  project.projectors[0].latency_ms = 0.169;
  CHECK(load(project));
  project.projectors[0].latency_ms = 0.171;
  const auto latency = load(project);
  REQUIRE_FALSE(latency);
  CHECK(latency.fault().code == "rig.differs");
  CHECK(names(latency.fault(), "latency"));

  project = sample::project();
  project.glasses.shutter_open_ms = 2.9;
  CHECK(names(load(project).fault(), "/glasses/shutter_open_ms"));

  project = sample::project(128, 48);
  const auto size = load(project);
  REQUIRE_FALSE(size);
  CHECK(names(size.fault(), "/projectors/0/width_px"));
}

TEST_CASE("a show of several projectors is refused by name, also by a rig that describes as many: one head is played") {
  Project project = sample::project();
  project.projectors.push_back(project.projectors[0]);
  project.projectors[1].name = "beside";
  const auto refused = load(project);
  REQUIRE_FALSE(refused);
  CHECK(refused.fault().code == "rig.differs");
  CHECK(names(refused.fault(), "\"beside\" would stay dark"));
  const auto two_heads = [](double frequency_hz) {
    RigDescription rig = rig_at(frequency_hz);
    rig.projectors.push_back(rig.projectors.at(0));
    return rig;
  };
  const ShowHeader header = sample::header_of(project);
  CHECK(fits_rig(header, project, two_heads(60.0)));
  const auto plan = admit(header, project, make_schedule(project, header.images), {}, {two_heads, RigLimits{}});
  REQUIRE_FALSE(plan);
  CHECK(plan.fault().code == "rig.differs");
  CHECK(names(plan.fault(), "several projectors"));
}

TEST_CASE("a show whose samples are not those of its project is held by its samples") {
  const Project project = sample::project();
  ShowHeader header = sample::header_of(project);
  CHECK(fits_rig(header, project, rig_at(60.0)));
  for (double& current_a : header.schedule.lens_drive_a.right) current_a *= 1.05;
  const Status drive = fits_rig(header, project, rig_at(60.0));
  CHECK(drive.fault().code == "rig.differs");
  CHECK(names(drive.fault(), "D"));
  header = sample::header_of(project);
  header.schedule.slots[3].trigger_s += 30e-6;
  CHECK(names(fits_rig(header, project, rig_at(60.0)).fault(), "30 us"));
}

TEST_CASE("a show whose project has findings that are errors is refused, naming the first") {
  Project project = sample::project();
  project.slices.powers_d = {-1.0, 0.5};  // 1.5 D apart: slices.spacing
  const auto show = load(project);
  REQUIRE_FALSE(show);
  CHECK(show.fault().code == "rig.refused");
  CHECK(names(show.fault(), "slices.spacing"));
}

TEST_CASE("a show beyond the rig's own limits is refused, whatever the show says") {
  RigLimits limits;
  limits.lens_current_max_a = 0.05;  // +-2 D need 0.054 A
  const auto show = load(sample::project(), limits);
  REQUIRE_FALSE(show);
  CHECK(show.fault().code == "rig.refused");
  CHECK(names(show.fault(), "0.05 A"));
  limits = {};
  limits.shutter_changes_per_s_max = 100;
  CHECK(names(load(sample::project(), limits).fault(), "100 per second"));
  limits = {};
  limits.light_share_max = 0.2;  // eight times 0.5 ms are 0.24 of 16.7 ms
  CHECK(names(load(sample::project(), limits).fault(), "share"));
}

TEST_CASE("what is no show, or not there, is a fault") {
  const sample::Folder folder;
  CHECK_FALSE(load_show(folder.path() / "none.h5", "a", {rig_at, {}}));
}

}  // namespace
}  // namespace focalstage
