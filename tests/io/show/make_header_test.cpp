#include <doctest/doctest.h>

#include <cmath>

#include "io/show/show.h"
#include "tests/io/show/sample.h"

namespace focalstage {
namespace {

/// Ten frames at 30 Hz; an object that moves 0.3 m along x in 0.3 s and turns a quarter about y; a hidden surface.
Project moving() {
  Project project;
  project.projectors.resize(1);
  project.projectors[0].frames_per_second = 1500;
  project.slices.powers_d = {-0.5, 0.5};
  project.frames = {10, 30.0, {}};
  project.viewer.placement.pose.position_m = {0, 1.5, 0};
  Object object;
  object.name = "mover";
  const double half_quarter = std::sqrt(0.5);
  object.placement.keys = {{0.0, {}, {}}, {0.3, {{0.3, 0, 0}, glm::dquat(half_quarter, 0, half_quarter, 0)}, {}}};
  project.objects = {object};
  Surface surface;
  surface.hidden = true;
  surface.placement.pose.position_m = {0, 0, -0.5};
  project.surfaces = {surface};
  return project;
}

ShowHeader header_of(const Project& project, FrameRange range) {
  const LoadedAssets assets{{}, {sample::asset("a.obj", "v 0 0 0\n")}};
  const CompileSettings settings = compile_settings(project);
  return make_show_header(project, "text", assets, sample::schedule(settings.images), settings, range);
}

TEST_CASE("a header says where everything stands in each frame") {
  const ShowHeader header = header_of(moving(), {0, 10});
  CHECK(header.frames == 10);
  CHECK(header.frames_per_second == 1500);
  CHECK(header.width_px == 1024);
  CHECK(header.images.size() == 4);
  CHECK(header.project_text == "text");
  CHECK(header.assets[0].path == "a.obj");
  REQUIRE(header.poses.size() == 10);
  for (std::size_t k = 0; k < 10; ++k) {
    const FramePoses& poses = header.poses[k];
    CHECK(poses.viewer == PoseRow{0, 1.5, 0, 0, 0, 0, 1});
    CHECK(poses.surfaces == std::vector<PoseRow>{{0, 0, -0.5, 0, 0, 0, 1}});
    // Frame k shows time k/30: a ninth of the way per frame, and so much of 90 degrees.
    const double share = static_cast<double>(k) / 9.0;
    const double half_angle = share * std::acos(-1.0) / 4.0;
    REQUIRE(poses.objects.size() == 1);
    CHECK(poses.objects[0][0] == doctest::Approx(0.3 * share).epsilon(1e-12));
    CHECK(poses.objects[0][4] == doctest::Approx(std::sin(half_angle)).epsilon(1e-12));
    CHECK(poses.objects[0][6] == doctest::Approx(std::cos(half_angle)).epsilon(1e-12));
  }
}

TEST_CASE("a range of frames keeps the project's time") {
  const ShowHeader whole = header_of(moving(), {0, 10});
  const ShowHeader part = header_of(moving(), {4, 7});
  CHECK(part.first_frame == 4);
  CHECK(part.frames == 3);
  CHECK(part.poses == std::vector<FramePoses>(whole.poses.begin() + 4, whole.poses.begin() + 7));
}

TEST_CASE("a cue falls on the nearest frame that there is") {
  Project project = moving();
  // 30 Hz: 0.1 s is frame 3, 0.149 s is 4.47, 0.151 s is 4.53.
  project.cues = {{"begin", 0, {}}, {"a", 0.1, {}}, {"b", 0.149, {}}, {"c", 0.151, {}}, {"late", 1e9, {}}};
  CHECK(header_of(project, {0, 10}).cues ==
        std::vector<ShowCue>{{"begin", 0}, {"a", 3}, {"b", 4}, {"c", 5}, {"late", 9}});
  CHECK(header_of(project, {4, 6}).cues == std::vector<ShowCue>{{"b", 0}, {"c", 1}});
}

}  // namespace
}  // namespace focalstage
