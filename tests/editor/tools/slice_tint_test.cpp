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

Rgb tint_of(const Project& project) {
  const auto room = stage(project, Assets{}, 0.0);
  REQUIRE(room);
  Picker picker;
  const auto tint = slice_tint(project, *room, room->objects[0], room->objects[0].drawables[0], picker);
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
