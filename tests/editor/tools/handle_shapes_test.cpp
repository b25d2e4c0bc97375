#include "editor/tools/handle_shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "editor/tools/room_camera.h"

using namespace focalstage;

namespace {

const glm::dvec2 size_px{800.0, 600.0};
const RoomView oblique = view_of({{0, 0, 0}, 2.0, -35.0, 25.0}, size_px);

bool has(const std::vector<HandleShape>& shapes, Handle handle) {
  return std::any_of(shapes.begin(), shapes.end(), [&](const HandleShape& s) { return s.handle == handle; });
}

}  // namespace

TEST_CASE("arms have the same length on the screen whatever the distance, and follow the scale") {
  for (const double distance_m : {0.3, 3.0, 30.0}) {
    const RoomView view = view_of({{0, 0, 0}, distance_m, 0.0, 0.0}, size_px);
    const glm::dvec2 tip = 0.5 * size_px + glm::dvec2(70.0, 0.0);
    CHECK(handle_at(handle_shapes(HandleTool::move, {}, view), tip) == Handle::x);
    const glm::dvec2 far_tip = 0.5 * size_px + glm::dvec2(140.0, 0.0);
    CHECK(!handle_at(handle_shapes(HandleTool::move, {}, view), far_tip));
    CHECK(handle_at(handle_shapes(HandleTool::move, {}, view, 2.0), far_tip, 2.0) == Handle::x);
  }
}

TEST_CASE("all seven handles move, the middle wins at the middle") {
  const auto shapes = handle_shapes(HandleTool::move, {}, oblique);
  for (const Handle handle : {Handle::x, Handle::y, Handle::z, Handle::yz, Handle::zx, Handle::xy, Handle::view}) {
    CHECK(has(shapes, handle));
  }
  CHECK(handle_at(shapes, 0.5 * size_px) == Handle::view);
}

TEST_CASE("an axis that points at the camera can't be held, nor a plane seen from its edge") {
  const RoomView along_z = view_of({{0, 0, 0}, 2.0, 0.0, 0.0}, size_px);
  const auto shapes = handle_shapes(HandleTool::move, {}, along_z);
  CHECK(!has(shapes, Handle::z));
  CHECK(!has(shapes, Handle::yz));
  CHECK(has(shapes, Handle::xy));
  const auto rings = handle_shapes(HandleTool::turn, {}, along_z);
  CHECK(has(rings, Handle::z));
}

TEST_CASE("a ring is held on its near half") {
  const auto shapes = handle_shapes(HandleTool::turn, {}, oblique);
  const double per_px_m = metres_per_px(oblique, {0, 0, 0});
  const glm::dvec3 to_camera = glm::normalize(oblique.world_from_camera.position_m);
  const glm::dvec3 near_half = glm::normalize(glm::dvec3(to_camera.x, 0.0, to_camera.z));  // on the ring about y
  CHECK(handle_at(shapes, *pixel_of(oblique, 72.0 * per_px_m * near_half)) == Handle::y);
  const glm::dvec2 far_px = *pixel_of(oblique, -72.0 * per_px_m * near_half);
  CHECK(handle_at(shapes, far_px) != Handle::y);
}

TEST_CASE("behind the camera there is nothing to hold, and nothing to measure with") {
  HandleFrame frame;
  frame.origin_m = oblique.world_from_camera.point({0.0, 0.0, 1.0});
  CHECK(handle_shapes(HandleTool::move, frame, oblique).empty());
  CHECK(handle_shapes(HandleTool::measure, {}, oblique).empty());
}
