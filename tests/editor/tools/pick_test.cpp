#include "editor/tools/pick.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/stage/primitive_cache.h"
#include "editor/tools/room_camera.h"

using namespace focalstage;

namespace {

/// A screen at z = -1 and a sphere of 0.1 m before it at z = -0.5, made of a unit mesh scaled down.
Stage screen_and_ball() {
  Stage stage;
  StagedSurface screen;
  screen.name = "screen";
  screen.drawables = {{*primitive_mesh(PlaneMesh{{1.0, 1.0}}), glm::translate(glm::dmat4(1.0), {0, 0, -1.0}), {}}};
  stage.surfaces = {screen};
  StagedObject ball;
  ball.name = "ball";
  ball.drawables = {{*primitive_mesh(SphereMesh{1.0}),
                     glm::scale(glm::translate(glm::dmat4(1.0), {0, 0, -0.5}), glm::dvec3(0.1)),
                     {}}};
  stage.objects = {ball};
  return stage;
}

const Ray ahead{{0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}};

}  // namespace

TEST_CASE("the nearest thing is met, at its place in the world, with its face towards the ray") {
  Picker picker;
  const auto hit = picker.first(screen_and_ball(), ahead);
  REQUIRE(hit);
  CHECK(hit->thing == StagedName{"objects", "ball"});
  CHECK(hit->distance_m == doctest::Approx(0.4).epsilon(0.01));
  CHECK(hit->normal.z > 0.99);
  CHECK(glm::length(hit->normal) == doctest::Approx(1.0));
}

TEST_CASE("what may not be picked lets the ray through; surfaces can be asked for alone") {
  Picker picker;
  const Stage stage = screen_and_ball();
  const auto unlocked = [](const StagedName& thing) { return thing.name != "ball"; };
  CHECK(picker.first(stage, ahead, unlocked)->thing.name == "screen");
  CHECK(picker.first_surface(stage, ahead)->distance_m == doctest::Approx(1.0));
  CHECK(!picker.first(stage, {{0, 0, 0}, {0, 0, 1}}));
}

TEST_CASE("moving a thing keeps its tree, and what left the stage is forgotten") {
  Picker picker;
  Stage stage = screen_and_ball();
  picker.first(stage, ahead);
  CHECK(picker.meshes() == 2);
  stage.objects[0].drawables[0].world_from_mesh = glm::translate(glm::dmat4(1.0), {3.0, 0, -0.5});
  CHECK(picker.first(stage, ahead)->thing.name == "screen");
  CHECK(picker.meshes() == 2);
  stage.objects.clear();
  picker.keep_only(stage);
  CHECK(picker.meshes() == 1);
}

TEST_CASE("bounds stand in the world") {
  const Stage stage = screen_and_ball();
  const Bounds ball = world_bounds(stage.objects[0].drawables);
  CHECK(ball.min_m.z == doctest::Approx(-0.6).epsilon(0.01));
  CHECK(ball.max_m.z == doctest::Approx(-0.4).epsilon(0.01));
  const Bounds all = stage_bounds(stage, {}, true);
  CHECK(all.min_m.z == doctest::Approx(-1.0));
  CHECK(all.max_m.z == doctest::Approx(0.18));  // the back of the head
  CHECK(stage_bounds(Stage{}, {}, true).min_m.z == doctest::Approx(-0.5));
  CHECK(stage_bounds(Stage{}).empty());
}

TEST_CASE("a box selects what lies wholly inside it") {
  const Stage stage = screen_and_ball();
  const glm::dvec2 size_px{400.0, 400.0};
  const RoomView view = view_of({{0, 0, -0.7}, 2.0, 0.0, 0.0}, size_px);
  const glm::dvec2 ball_px = *pixel_of(view, {0, 0, -0.5});
  const glm::dvec2 around{60.0, 60.0};
  const auto found = inside_box(stage, view, ball_px + around, ball_px - around);  // corners in any order
  REQUIRE(found.size() == 1);
  CHECK(found[0].name == "ball");
  CHECK(inside_box(stage, view, {0, 0}, size_px).size() == 2);
  CHECK(inside_box(stage, view, ball_px, ball_px + around).empty());  // half of the ball
}
