#include "editor/tools/handle_drag.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "editor/tools/room_camera.h"

using namespace focalstage;

namespace {

const glm::dvec2 size_px{800.0, 600.0};
const RoomView oblique = view_of({{0, 0, -0.4}, 2.0, -35.0, 25.0}, size_px);
const Rigid viewer{{0.0, 0.1, 0.2}, glm::dquat(1, 0, 0, 0)};

HandleThing thing_at(const glm::dvec3& position_m) { return {"objects", "thing", Rigid{position_m}}; }

struct Held {
  HandleFrame frame;
  HandleDrag drag;
};

Held hold(HandleTool tool, Handle handle, HandleSpace space, std::vector<HandleThing> things,
          const RoomView& view = oblique) {
  const HandleFrame frame = handle_frame(space, things, viewer);
  return {frame, drag_start(tool, handle, frame, view, *pixel_of(view, frame.origin_m), viewer, std::move(things))};
}

double between(const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b); }

}  // namespace

TEST_CASE("along an axis the thing stays under the pointer") {
  const glm::dvec3 start{0.1, -0.05, -0.5};
  const Held held = hold(HandleTool::move, Handle::x, HandleSpace::world, {thing_at(start)});
  const glm::dvec3 wanted = start + glm::dvec3(0.237, 0, 0);
  const Dragged dragged = drag_to(held.drag, *pixel_of(oblique, wanted), {});
  CHECK(between(dragged.things[0].pose.position_m, wanted) < 1e-9);
  CHECK(dragged.amount == "+0.237 m");
  // Beside the axis: still only along it.
  const Dragged beside = drag_to(held.drag, *pixel_of(oblique, wanted) + glm::dvec2(0.0, 30.0), {});
  CHECK(beside.things[0].pose.position_m.y == start.y);
  CHECK(beside.things[0].pose.position_m.z == start.z);
}

TEST_CASE("in a plane and square to the view the thing stays under the pointer") {
  const glm::dvec3 start{0.1, -0.05, -0.5};
  const Held plane = hold(HandleTool::move, Handle::zx, HandleSpace::world, {thing_at(start)});
  const glm::dvec3 wanted = start + glm::dvec3(-0.12, 0.0, 0.2);
  CHECK(between(drag_to(plane.drag, *pixel_of(oblique, wanted), {}).things[0].pose.position_m, wanted) < 1e-9);

  const Held view = hold(HandleTool::move, Handle::view, HandleSpace::world, {thing_at(start)});
  const glm::dvec2 pixel{555.0, 222.0};
  const glm::dvec3 end = drag_to(view.drag, pixel, {}).things[0].pose.position_m;
  CHECK(glm::length(*pixel_of(oblique, end) - pixel) < 1e-9);
  CHECK(depth_m(oblique, end) == doctest::Approx(depth_m(oblique, start)));
}

TEST_CASE("along the sight nothing moves for the viewer but the distance") {
  const std::vector<HandleThing> things{thing_at({0.1, -0.05, -0.5}), thing_at({-0.2, 0.0, -0.8})};
  const Held held = hold(HandleTool::move, Handle::z, HandleSpace::sight, things);
  const std::array<double, 1> by{0.3};
  for (const bool keep : {false, true}) {
    const Dragged dragged = drag_by(held.drag, by, {.keep_angular_size = keep});
    for (std::size_t i = 0; i < 2; ++i) {
      const glm::dvec3 before = things[i].pose.position_m - viewer.position_m;
      const glm::dvec3 after = dragged.things[i].pose.position_m - viewer.position_m;
      CHECK(glm::dot(glm::normalize(before), glm::normalize(after)) == doctest::Approx(1.0).epsilon(1e-12));
      const double grown = glm::length(after) / glm::length(before);
      CHECK(dragged.things[i].scale == doctest::Approx(keep ? grown : 1.0));
      if (!keep) CHECK(glm::length(after) - glm::length(before) == doctest::Approx(0.3));
    }
  }
  // Dragged through the viewer it stops before the eyes, never behind them.
  const std::array<double, 1> far_back{-5.0};
  const glm::dvec3 end = drag_by(held.drag, far_back, {}).things[0].pose.position_m;
  CHECK(glm::dot(end - viewer.position_m, things[0].pose.position_m - viewer.position_m) > 0.0);
}

TEST_CASE("snapping rounds where it comes to stand in the world, and the distance along the sight") {
  const Held world = hold(HandleTool::move, Handle::x, HandleSpace::world, {thing_at({0.1234, 0.0, -0.5})});
  const DragWish snap{.snap = true, .snap_m = 0.05};
  const glm::dvec3 end = drag_to(world.drag, *pixel_of(oblique, {0.27, 0.0, -0.5}), snap).things[0].pose.position_m;
  CHECK(end.x == doctest::Approx(0.25));

  const Held sight = hold(HandleTool::move, Handle::z, HandleSpace::sight, {thing_at({0.1, 0.0, -0.5})});
  const glm::dvec3 way = glm::normalize(glm::dvec3(0.1, 0.0, -0.5) - viewer.position_m);
  const Dragged dragged = drag_to(sight.drag, *pixel_of(oblique, viewer.position_m + 0.93 * way), snap);
  CHECK(glm::length(dragged.things[0].pose.position_m - viewer.position_m) == doctest::Approx(0.95));
}

TEST_CASE("a ring turns by the angle that the hand went round its centre, several things about their middle") {
  const RoomView front = view_of({{0, 0, 0}, 2.0, 0.0, 0.0}, size_px);
  const std::vector<HandleThing> things{thing_at({0.2, 0.0, 0.0}), thing_at({-0.2, 0.0, 0.0})};
  Held held = hold(HandleTool::turn, Handle::z, HandleSpace::world, things, front);
  held.drag.start_px = *pixel_of(front, {0.1, 0.0, 0.0});
  const double angle = glm::radians(32.0);
  const glm::dvec2 pixel = *pixel_of(front, {0.3 * std::cos(angle), 0.3 * std::sin(angle), 0.0});
  const Dragged dragged = drag_to(held.drag, pixel, {});
  CHECK(between(dragged.things[0].pose.position_m, {0.2 * std::cos(angle), 0.2 * std::sin(angle), 0.0}) < 1e-9);
  CHECK(between(dragged.things[0].pose.direction({1, 0, 0}), {std::cos(angle), std::sin(angle), 0.0}) < 1e-9);
  CHECK(dragged.amount == "+32.0\u00b0");
  CHECK(drag_to(held.drag, pixel, {.snap = true, .snap_deg = 15.0}).amount == "+30.0\u00b0");
}

TEST_CASE("a ring seen from its edge turns like a wheel, its near side with the hand") {
  const RoomView front = view_of({{0, 0, 0}, 2.0, 0.0, 0.0}, size_px);
  Held held = hold(HandleTool::turn, Handle::y, HandleSpace::world, {thing_at({0, 0, 0})}, front);
  const Dragged dragged = drag_to(held.drag, held.drag.start_px + glm::dvec2(36.0, 0.0), {});
  // The near side (+z) goes to the right (+x): a positive turn about y. 36 px of a radius of 72 are half a radian.
  const glm::dvec3 near_side = dragged.things[0].pose.direction({0, 0, 1});
  CHECK(near_side.x == doctest::Approx(std::sin(0.5)).epsilon(1e-6));
}

TEST_CASE("scaling follows the pointer's distance from the centre, and never turns inside out") {
  const RoomView front = view_of({{0, 0, 0}, 2.0, 0.0, 0.0}, size_px);
  Held held = hold(HandleTool::scale, Handle::x, HandleSpace::world, {thing_at({0, 0, 0})}, front);
  held.drag.start_px = 0.5 * size_px + glm::dvec2(78.0, 0.0);
  CHECK(drag_to(held.drag, 0.5 * size_px + glm::dvec2(117.0, 0.0), {}).things[0].scale == doctest::Approx(1.5));
  CHECK(drag_to(held.drag, 0.5 * size_px - glm::dvec2(500.0, 0.0), {}).things[0].scale > 0.0);
  const std::array<double, 1> doubled{2.0};
  CHECK(drag_by(held.drag, doubled, {}).things[0].scale == 2.0);
  CHECK(drag_by(held.drag, {}, {}).things[0].scale == 1.0);
}

TEST_CASE("beyond the horizon of a plane the drag stops, finite and in front") {
  const RoomView low = view_of({{0, 0, 0}, 2.0, 0.0, 4.0}, size_px);
  const Held held = hold(HandleTool::move, Handle::zx, HandleSpace::world, {thing_at({0, 0, 0})}, low);
  const glm::dvec3 end = drag_to(held.drag, {400.0, -5000.0}, {}).things[0].pose.position_m;
  CHECK(std::isfinite(end.x));
  CHECK(end.z < 0.0);  // away, and not round behind the camera
}

TEST_CASE("local axes are the last thing's") {
  HandleThing turned = thing_at({0, 0, -0.5});
  turned.pose.rotation = glm::angleAxis(glm::radians(90.0), glm::dvec3(0, 1, 0));
  const HandleFrame frame = handle_frame(HandleSpace::local, {thing_at({0, 0, -0.5}), turned}, viewer);
  CHECK(between(frame.axes[0], {0, 0, -1}) < 1e-12);
}

TEST_CASE("sight axes are square to each other, also straight above the viewer") {
  for (const glm::dvec3& place : {glm::dvec3(0.3, 0.2, -0.5), viewer.position_m + glm::dvec3(0, 1, 0)}) {
    const HandleFrame frame = handle_frame(HandleSpace::sight, {thing_at(place)}, viewer);
    CHECK(between(frame.axes[2], glm::normalize(place - viewer.position_m)) < 1e-12);
    for (int i = 0; i < 3; ++i) {
      CHECK(std::abs(glm::dot(frame.axes[i], frame.axes[(i + 1) % 3])) < 1e-12);
      CHECK(glm::length(frame.axes[i]) == doctest::Approx(1.0));
    }
    CHECK(frame.coordinates_m.z == doctest::Approx(between(place, viewer.position_m)));
  }
}
