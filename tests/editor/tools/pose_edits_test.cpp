#include "editor/tools/pose_edits.h"

#include <doctest/doctest.h>

using namespace focalstage;

namespace {

Project with_objects() {
  Project project;
  Object still;
  still.name = "still";
  still.mesh.shape = BoxMesh{};
  project.objects.push_back(still);
  Object keyed = still;
  keyed.name = "keyed";
  keyed.placement.keys = {{0.0, Rigid{{0, 0, -1}}}, {1.0, Rigid{{1, 0, -1}}}};
  project.objects.push_back(keyed);
  Projector projector;
  projector.name = "main";
  project.projectors.push_back(projector);
  return project;
}

}  // namespace

TEST_CASE("only what changed is set, and the project takes it") {
  const Project project = with_objects();
  const HandleThing from = *handle_thing(project, "objects", "still", 0.0);
  HandleThing to = from;
  CHECK(pose_edits(project, from, to, 0.0).empty());
  to.pose.position_m = {0.1, 0.2, -0.3};
  to.scale = 0.5;
  const auto edits = pose_edits(project, from, to, 0.0);
  CHECK(edits.size() == 2);
  const auto after = apply_all(project, edits);
  REQUIRE(after);
  CHECK(*handle_thing(*after, "objects", "still", 0.0) == to);
}

TEST_CASE("a thing with keys gets the key of the moment") {
  const Project project = with_objects();
  const HandleThing from = *handle_thing(project, "objects", "keyed", 0.5);
  CHECK(from.pose.position_m.x == doctest::Approx(0.5));
  HandleThing to = from;
  to.pose.position_m.y = 0.7;
  const auto after = apply_all(project, pose_edits(project, from, to, 0.5));
  REQUIRE(after);
  CHECK(after->objects[1].placement.keys.size() == 3);
  CHECK(handle_thing(*after, "objects", "keyed", 0.5)->pose.position_m == to.pose.position_m);
  CHECK(handle_thing(*after, "objects", "keyed", 1.0)->pose.position_m == glm::dvec3(1, 0, -1));
  // At the same moment again: that key is replaced.
  to.pose.position_m.y = 0.9;
  const auto again = apply_all(*after, pose_edits(*after, from, to, 0.5));
  REQUIRE(again);
  CHECK(again->objects[1].placement.keys.size() == 3);
}

TEST_CASE("every step of a drag sets the same keys, also where the hand is back at its start") {
  const Project project = with_objects();
  const std::vector<HandleThing> from{*handle_thing(project, "objects", "still", 0.0)};
  const auto edits = drag_edits(project, HandleTool::move, from, from, false, 0.0);
  REQUIRE(edits.size() == 1);
  CHECK(edits[0].key == "position_m");
  CHECK(drag_edits(project, HandleTool::move, from, from, true, 0.0).size() == 2);
  CHECK(drag_edits(project, HandleTool::turn, from, from, false, 0.0)[0].key == "rotation_xyzw");
}

TEST_CASE("the viewer and projectors have no size; what has no place has no handles") {
  const Project project = with_objects();
  CHECK(!handle_thing(project, "viewer", "", 0.0)->scales);
  const HandleThing projector = *handle_thing(project, "projectors", "main", 0.0);
  HandleThing to = projector;
  to.scale = 2.0;
  CHECK(pose_edits(project, projector, to, 0.0).empty());
  CHECK(!handle_thing(project, "sweep", "", 0.0));
  CHECK(!handle_thing(project, "objects", "nobody", 0.0));
}
