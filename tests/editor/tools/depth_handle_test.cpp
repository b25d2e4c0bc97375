#include "editor/tools/depth_handle.h"

#include <doctest/doctest.h>

#include <cmath>

#include <glm/geometric.hpp>

#include "core/mesh/model.h"
#include "editor/tools/room_camera.h"
#include "editor/tools/slice_sheets.h"

using namespace focalstage;

namespace {

/// A 10 cm box whose centre is 0.4 m from the lens centre, before a screen at 0.5 m from it.
Project box_before_screen() {
  Project project;
  project.glasses.lens_to_pupil_mm = 15.0;
  project.slices.powers_d = {-1.0, 0.0, 1.0, 2.5};
  Surface screen;
  screen.name = "screen";
  screen.mesh.shape = PlaneMesh{{0.8, 0.6}};
  screen.placement.pose.position_m = {0, 0, -0.515};
  project.surfaces.push_back(screen);
  Object box;
  box.name = "box";
  box.mesh.shape = BoxMesh{{0.1, 0.1, 0.1}};
  box.placement.pose.position_m = {0, 0, -0.415};
  project.objects.push_back(box);
  return project;
}

DepthReading reading_of(const Project& project) {
  const auto room = stage(project, Assets{}, 0.0);
  REQUIRE(room);
  Picker picker;
  const auto reading = read_depth(project, *room, room->objects[0], picker);
  REQUIRE(reading);
  return *reading;
}

}  // namespace

TEST_CASE("placed, fixed, offset and pinned depths, against the eyes' vergence") {
  Project project = box_before_screen();
  DepthReading placed = reading_of(project);
  CHECK(placed.vergence_d == doctest::Approx(2.5));  // 1 / 0.4 m
  CHECK(placed.conflict_d == doctest::Approx(0.0));
  CHECK(!placed.tires());

  project.objects[0].depth = {DepthMode::fixed, 1.9, 0};
  CHECK(reading_of(project).conflict_d == doctest::Approx(-0.6));
  CHECK(reading_of(project).tires());

  project.objects[0].depth = {DepthMode::offset, 0.25, 0};
  CHECK(reading_of(project).accommodation_d == doctest::Approx(2.75));

  project.objects[0].depth = {DepthMode::slice, 0.0, 2};  // 1 D before a screen at 2 D: 1 m away
  CHECK(*reading_of(project).surface_m == doctest::Approx(0.5));
  CHECK(reading_of(project).accommodation_d == doctest::Approx(1.0));
}

TEST_CASE("nothing is said of what lies behind the viewer or of slices that are not there") {
  Project project = box_before_screen();
  Picker picker;
  project.objects[0].depth = {DepthMode::slice, 0.0, 9};
  auto room = stage(project, Assets{}, 0.0);
  CHECK(!read_depth(project, *room, room->objects[0], picker));
  project.objects[0].depth = {};
  project.objects[0].placement.pose.position_m.z = 1.0;
  room = stage(project, Assets{}, 0.0);
  CHECK(!read_depth(project, *room, room->objects[0], picker));
}

TEST_CASE("the sheet stands at the wanted distance and covers the object as the viewer sees it") {
  const Project project = box_before_screen();
  const auto room = stage(project, Assets{}, 0.0);
  const SightFrame sight = sight_frame(project, *room);
  const auto sheet = depth_sheet(sight, room->objects[0], 1.25);
  REQUIRE(sheet);
  for (const glm::dvec3& corner : sheet->corners_m) CHECK(sight.axial_m(corner) == doctest::Approx(0.8));
  // The near face, half width 0.05 at 0.365 m from the pupils, is the widest part that is seen.
  CHECK(sight.look_at(sheet->corners_m[2])->x > 0.05 / 0.365);
  CHECK(sight.look_at(sheet->corners_m[2])->x < 1.2 * 0.05 / 0.365);
  CHECK(!depth_sheet(sight, room->objects[0], 0.0));
  CHECK(!depth_sheet(sight, room->objects[0], -1.0));
}

TEST_CASE("the sheet follows the hand along the line of sight") {
  const Project project = box_before_screen();
  const auto room = stage(project, Assets{}, 0.0);
  const SightFrame sight = sight_frame(project, *room);
  const RoomView view = view_of({{0, 0, -0.4}, 1.8, -60.0, 20.0}, {800.0, 600.0});
  const auto sheet = depth_sheet(sight, room->objects[0], 2.5);
  const glm::dvec2 grabbed = *pixel_of(view, sheet->centre_m) + glm::dvec2(6.0, 4.0);  // beside the line
  const DepthDrag drag = start_depth_drag(room->objects[0], sight, *sheet, 2.5, view, grabbed);
  CHECK(vergence_dragged_d(drag, grabbed) == doctest::Approx(2.5));
  const glm::dvec2 to = *pixel_of(view, sight.point_at(sheet->look, 0.625));
  const glm::dvec2 from = *pixel_of(view, sheet->centre_m);
  const DepthDrag straight = start_depth_drag(room->objects[0], sight, *sheet, 2.5, view, from);
  CHECK(vergence_dragged_d(straight, to) == doctest::Approx(1.6));
  CHECK(vergence_dragged_d(straight, to, 0.25) == doctest::Approx(1.5));
  for (const glm::dvec2& wild : {glm::dvec2(-9e3, 0.0), glm::dvec2(9e3, 9e3), glm::dvec2(400.0, -9e3)}) {
    const double vergence_d = vergence_dragged_d(straight, wild);
    CHECK(vergence_d >= 0.05);
    CHECK(vergence_d <= 20.0);
  }
}

TEST_CASE("the edit is one that the project takes, rounded so that a file stays readable") {
  const auto after = apply(box_before_screen(), depth_edit("box", 2.50004));
  REQUIRE(after);
  CHECK(after->objects[0].depth == Depth{DepthMode::fixed, 2.5, 0});
}

TEST_CASE("slices' sheets stand where the surface's picture does, those far away are told and not drawn") {
  const Project project = box_before_screen();
  const auto room = stage(project, Assets{}, 0.0);
  Picker picker;
  const auto sheets = slice_sheets(project, *room, picker);
  REQUIRE(sheets.size() == 4);
  CHECK(sheets[0].vergence_d == doctest::Approx(3.0));  // 1 / 0.5 m + 1 D
  CHECK(sheets[0].drawn);
  CHECK(sight_frame(project, *room).axial_m(sheets[0].corners_m[1]) == doctest::Approx(1.0 / 3.0));
  CHECK(sheets[1].corners_m[2].z == doctest::Approx(-0.515));  // no power: the screen itself
  CHECK(sheets[1].corners_m[2].x == doctest::Approx(0.4));
  CHECK(sheets[3].vergence_d == doctest::Approx(-0.5));
  CHECK(!sheets[3].drawn);
  CHECK(slice_sheets(project, Stage{}, picker).empty());
}
