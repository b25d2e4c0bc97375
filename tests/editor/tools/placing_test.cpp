#include <doctest/doctest.h>

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/stage/primitive_cache.h"
#include "editor/tools/align.h"
#include "editor/tools/drop.h"
#include "editor/tools/measure.h"

using namespace focalstage;

namespace {

Drawable box_at(const glm::dvec3& centre_m, double size_m) {
  return {*primitive_mesh(BoxMesh{glm::dvec3(size_m)}), glm::translate(glm::dmat4(1.0), centre_m), {}};
}

Aligned item(const glm::dvec3& centre_m, double size_m) {
  return {{"objects", "box", Rigid{centre_m}}, world_bounds({box_at(centre_m, size_m)})};
}

}  // namespace

TEST_CASE("aligning levels ends of bounds with the last's") {
  const std::vector<Aligned> things{item({0.0, 0.5, 0.0}, 0.2), item({0.3, -0.1, 0.7}, 0.4)};
  const auto low = aligned(things, 1, AlignTo::low);  // the last stands on y = -0.3
  CHECK(low[0].pose.position_m.y == doctest::Approx(-0.2));
  CHECK(low[0].pose.position_m.x == 0.0);
  CHECK(low[1] == things[1].thing);
  CHECK(aligned(things, 1, AlignTo::high)[0].pose.position_m.y == doctest::Approx(0.0));
  CHECK(aligned(things, 0, AlignTo::middle)[0].pose.position_m.x == doctest::Approx(0.3));
}

TEST_CASE("at the same distance, each in its own direction") {
  const Rigid viewer{{0.0, 1.0, 0.0}};
  const std::vector<HandleThing> things{{"objects", "a", Rigid{{1.0, 1.0, -1.0}}},
                                        {"objects", "b", Rigid{{0.0, 1.0, -0.5}}}};
  const auto moved = at_same_distance(things, viewer);
  CHECK(glm::length(moved[0].pose.position_m - glm::dvec3(std::sqrt(0.125), 1.0, -std::sqrt(0.125))) < 1e-12);
  CHECK(moved[1] == things[1]);
}

TEST_CASE("what is dropped rests on what is below, not on itself") {
  Stage stage;
  StagedSurface table;
  table.name = "table";
  table.drawables = {box_at({0, 0, 0}, 1.0)};  // its top at 0.5
  stage.surfaces = {table};
  StagedObject box;
  box.name = "box";
  box.drawables = {box_at({0.1, 1.0, 0.1}, 0.2)};
  stage.objects = {box};
  Picker picker;
  const auto not_itself = [](const StagedName& thing) { return thing.name != "box"; };
  const glm::dvec3 down{0, -1, 0};
  CHECK(*drop_m(stage, box.drawables, down, picker, not_itself) == doctest::Approx(0.4));
  CHECK(!drop_m(stage, box.drawables, {0, 1, 0}, picker, not_itself));
  // Resting already: it goes nowhere.
  CHECK(*drop_m(stage, {box_at({0.1, 0.6, 0.1}, 0.2)}, down, picker, not_itself) < 1e-6);
}

TEST_CASE("a measure in metres, dioptres and degrees") {
  const SightFrame sight{Rigid{}, 0.015};
  // 0.4 m and 0.5 m from the lens centre, straight ahead: half a dioptre.
  const MeasuredGap depth = measured(sight, {0, 0, -0.415}, {0, 0, -0.515});
  CHECK(depth.distance_m == doctest::Approx(0.1));
  CHECK(*depth.difference_d == doctest::Approx(0.5));
  CHECK(depth.angle_deg == doctest::Approx(0.0));
  CHECK(measured(sight, {0.5, 0, -0.5}, {0, 0, -0.5}).angle_deg == doctest::Approx(45.0));
  CHECK(!measured(sight, {0, 0, 0.2}, {0, 0, -0.5}).difference_d);
}
