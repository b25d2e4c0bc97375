#include "editor/tools/slice_tint.h"

#include <doctest/doctest.h>

#include "core/mesh/model.h"

using namespace focalstage;

namespace {

Rgb bytes(const glm::dvec3& colour) { return Rgb(colour * 255.0 + 0.5); }

Project plane_before_screen(double at_m) {
  Project project;
  project.slices.powers_d = {1.0, -1.0, 0.0};  // in no order
  Surface screen;
  screen.name = "screen";
  screen.mesh.shape = PlaneMesh{{2.0, 2.0}};
  screen.placement.pose.position_m = {0, 0, -0.515};
  project.surfaces.push_back(screen);
  Object object;
  object.name = "plane";
  object.mesh.shape = PlaneMesh{{0.05, 0.05}};
  object.placement.pose.position_m = {0, 0, -at_m - 0.015};
  project.objects.push_back(object);
  return project;
}

Rgb tint_of(const Project& project, ObjectTint kind = ObjectTint::slices) {
  const auto room = stage(project, Assets{}, 0.0);
  REQUIRE(room);
  Picker picker;
  const auto tint = object_tint(kind, project, *room, room->objects[0], room->objects[0].drawables[0], picker);
  REQUIRE(!tint.empty());
  return tint[0];
}

}  // namespace

TEST_CASE("a slice that is no more has no colour of its own") {
  CHECK(slice_colour({-1.0, 0.0}, 2) == slice_colour({}, 0));
  CHECK(slice_colour({-1.0, 0.0}, 1) != slice_colour({-1.0, 0.0}, 0));
}

TEST_CASE("what wants a slice's power has that slice's colour, what lies between is mixed") {
  const std::vector<double> powers_d{1.0, -1.0, 0.0};
  CHECK(tint_of(plane_before_screen(1.0 / 3.0)) == bytes(slice_colour(powers_d, 1)));  // 2 D - 3 D = -1 D
  CHECK(tint_of(plane_before_screen(1.0)) == bytes(slice_colour(powers_d, 0)));        // 2 D - 1 D
  const glm::dvec3 mixed = 0.5 * (slice_colour(powers_d, 1) + slice_colour(powers_d, 2));
  const Rgb found = tint_of(plane_before_screen(0.4));  // 2 D - 2.5 D
  const Rgb expected = bytes(mixed);
  for (int c = 0; c < 3; ++c) CHECK(std::abs(int(found[c]) - int(expected[c])) <= 1);
  Project pinned = plane_before_screen(0.4);
  pinned.objects[0].depth = {DepthMode::slice, 0.0, 0};
  CHECK(tint_of(pinned) == bytes(slice_colour(powers_d, 0)));
}

TEST_CASE("where the slices put an object where it stands it is green; where they cannot, or shall not, red or blue") {
  const auto greenest = [](const Rgb& colour) { return colour.g > colour.r && colour.g > colour.b; };
  CHECK(greenest(tint_of(plane_before_screen(0.4), ObjectTint::conflict)));
  Project nearer = plane_before_screen(0.4);
  nearer.objects[0].depth = {DepthMode::fixed, 1.2, 0};  // the eyes converge at 2.5 D
  const Rgb far = tint_of(nearer, ObjectTint::conflict);
  CHECK(far.r > far.g);
  CHECK(far.r > far.b);
  const Rgb beyond = tint_of(plane_before_screen(0.2), ObjectTint::conflict);  // 5 D, of which the slices give 3
  CHECK(beyond.r > beyond.b);
  nearer.objects[0].depth = {DepthMode::fixed, 3.4, 0};
  nearer.slices.powers_d = {-1.5, 0.0};
  const Rgb near = tint_of(nearer, ObjectTint::conflict);
  CHECK(near.b > near.r);
}

TEST_CASE("where no surface is behind, no slice can be told") {
  Project project = plane_before_screen(0.4);
  project.surfaces.clear();
  CHECK(tint_of(project) == Rgb(110, 112, 116));
}

TEST_CASE("colours run from the lowest power to the highest, whatever their order in the project") {
  const std::vector<double> powers_d{1.0, -1.0, 0.0};
  CHECK(slice_colour(powers_d, 1).b > slice_colour(powers_d, 1).r);
  CHECK(slice_colour(powers_d, 0).r > slice_colour(powers_d, 0).b);
  CHECK(slice_colour({0.5}, 0) == slice_colour(powers_d, 1));
}
