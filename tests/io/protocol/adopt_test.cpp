#include "io/protocol/adopt.h"

#include <doctest/doctest.h>

#include "core/scene/edit.h"

using namespace focalstage;

namespace {

Project project_with_a_projector() {
  Project project;
  project.name = "Room";
  project.projectors.push_back({});
  project.projectors.front().name = "main";
  return project;
}

RigDescription rig_with_a_lag() {
  RigDescription rig;
  rig.projectors.push_back({});
  rig.projectors.front().name = "main";
  rig.projectors.front().latency_ms = 0.15;
  rig.projectors.front().frames_per_second = 2840.0;
  rig.glasses.lens_response.left = {{0, 38.0, 0.0, {}}, {1, 37.0, -15.0, {}}};
  rig.glasses.lens_response.right = {{0, 37.5, 0.0, {}}};
  rig.glasses.shutter_open_ms = 2.5;
  return rig;
}

}  // namespace

TEST_CASE("an adopted rig leaves nothing to adopt") {
  const Project before = project_with_a_projector();
  const RigDescription rig = rig_with_a_lag();
  const auto edits = adopt(before, rig);
  const auto after = apply_all(before, edits);
  REQUIRE(after.ok());
  CHECK(after->glasses.lens_response == rig.glasses.lens_response);
  CHECK(after->glasses.shutter_open_ms == 2.5);
  CHECK(after->projectors.front().latency_ms == 0.15);
  CHECK(adopt(*after, rig).empty());
}

TEST_CASE("a faster rig does not change the rate, a slower one does") {
  const Project before = project_with_a_projector();  // 2000 a second
  RigDescription rig = rig_with_a_lag();
  CHECK(apply_all(before, adopt(before, rig))->projectors.front().frames_per_second == 2000.0);
  rig.projectors.front().frames_per_second = 1440.0;
  CHECK(apply_all(before, adopt(before, rig))->projectors.front().frames_per_second == 1440.0);
}

TEST_CASE("a rig's lattice of pixels is adopted") {
  const Project before = project_with_a_projector();
  RigDescription rig = rig_with_a_lag();
  rig.projectors.front().pixel_layout = PixelLayout::diamond;
  const auto after = apply_all(before, adopt(before, rig));
  REQUIRE(after.ok());
  CHECK(after->projectors.front().pixel_layout == PixelLayout::diamond);
  CHECK(adopt(*after, rig).empty());
  CHECK(rig_values_of(rig).pixel_layout == PixelLayout::diamond);
}

TEST_CASE("a rig's current limit is taken where it is the lower") {
  Project before = project_with_a_projector();
  RigDescription rig = rig_with_a_lag();
  rig.lens_current_max_a = 0.2;
  const auto lower = apply_all(before, adopt(before, rig));
  REQUIRE(lower.ok());
  REQUIRE(lower->glasses.lens_limits);
  CHECK(lower->glasses.lens_limits->max_current_a == 0.2);
  CHECK(lower->glasses.lens_limits->max_rms_current_a == 0.25);
  CHECK(adopt(*lower, rig).empty());
  rig.lens_current_max_a = 0.4;
  CHECK(apply_all(*lower, adopt(*lower, rig))->glasses.lens_limits->max_current_a == 0.2);
  CHECK_FALSE(apply_all(before, adopt(before, rig))->glasses.lens_limits);
}

TEST_CASE("a projector of another name is adopted by its place") {
  Project before = project_with_a_projector();
  before.projectors.front().name = "upstairs";
  const auto edits = adopt(before, rig_with_a_lag());
  const auto after = apply_all(before, edits);
  REQUIRE(after.ok());
  CHECK(after->projectors.front().name == "upstairs");
  CHECK(after->projectors.front().latency_ms == 0.15);
}
