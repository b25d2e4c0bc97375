#include "editor/tools/motion_steer.h"

#include <doctest/doctest.h>

#include <cmath>

#include <glm/geometric.hpp>

using namespace focalstage;

namespace {

const glm::dvec2 size_px{600.0, 400.0};
const RoomCamera front{{0.0, 0.0, 0.0}, 2.0, 0.0, 0.0};  // at (0, 0, 2), looking along -Z

glm::dvec3 eye_of(const RoomCamera& camera) { return view_of(camera, size_px).world_from_camera.position_m; }
glm::dvec2 seen(const RoomCamera& camera, const glm::dvec3& point_m) {
  return *pixel_of(view_of(camera, size_px), point_m) - 0.5 * size_px;
}
double apart(const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b); }

HandMotion push(double x, double y, double z) { return {{x, y, z}, {}}; }
HandMotion turn(double x, double y, double z) { return {{}, {x, y, z}}; }

HandleThing thing_at(const glm::dvec3& position_m) {
  HandleThing thing;
  thing.pose.position_m = position_m;
  return thing;
}

}  // namespace

TEST_CASE("holding the room: it goes with the hand, on the screen") {
  const glm::dvec3 point(0.1, 0.2, 0.0);
  const glm::dvec2 before = seen(front, point);
  CHECK(seen(steered(front, push(1, 0, 0), {}, 0.1), point).x > before.x);
  CHECK(seen(steered(front, push(0, 1, 0), {}, 0.1), point).y < before.y);  // pixels grow downwards
  CHECK(steered(front, push(0, 0, 1), {}, 0.1).distance_m < front.distance_m);
  // What is nearer than the target, turned about the vertical by the right hand, goes to the right; about +X, down.
  const glm::dvec3 near(0.0, 0.0, 0.5);
  CHECK(seen(steered(front, turn(0, 1, 0), {}, 0.1), near).x > 1.0);
  CHECK(seen(steered(front, turn(1, 0, 0), {}, 0.1), near).y > 1.0);
  CHECK(steered(front, turn(0, 0, 1), {}, 0.1) == front);  // the horizon stays level
}

TEST_CASE("holding the room: one distance and 120 degrees a second at full deflection") {
  CHECK(apart(steered(front, push(1, 0, 0), {}, 0.5).target_m, {-1.0, 0.0, 0.0}) < 1e-12);
  CHECK(steered(front, push(0, 0, -1), {}, 1.0).distance_m == doctest::Approx(2.0 * std::exp(1.0)));
  CHECK(steered(front, turn(0, 1, 0), {}, 0.5).azimuth_deg == doctest::Approx(60.0));
  RoomCamera far = front;
  far.distance_m = 20.0;
  CHECK(apart(steered(far, push(1, 0, 0), {}, 0.5).target_m, {-10.0, 0.0, 0.0}) < 1e-12);
}

TEST_CASE("flying: the camera goes and looks where the hand does") {
  const SteerSettings fly{.fly = true};
  CHECK(apart(eye_of(steered(front, push(1, 0, 0), fly, 0.5)), {1.0, 0.0, 2.0}) < 1e-12);
  CHECK(apart(eye_of(steered(front, push(0, 1, 0), fly, 0.5)), {0.0, 1.0, 2.0}) < 1e-12);
  CHECK(apart(eye_of(steered(front, push(0, 0, -1), fly, 0.5)), {0.0, 0.0, 1.0}) < 1e-12);  // ahead
  const RoomCamera left = steered(front, turn(0, 1, 0), fly, 0.5);  // by the right hand about the vertical: to the left
  CHECK(apart(eye_of(left), eye_of(front)) < 1e-12);
  const glm::dvec3 gaze = view_of(left, size_px).world_from_camera.direction({0.0, 0.0, -1.0});
  CHECK(apart(gaze, {-std::sin(M_PI / 3.0), 0.0, -std::cos(M_PI / 3.0)}) < 1e-12);
  CHECK(steered(front, turn(1, 0, 0), fly, 0.1).elevation_deg < 0.0);  // up
}

TEST_CASE("time counts, frames do not") {
  for (const bool fly : {false, true}) {
    for (const HandMotion& motion : {push(0.5, -0.2, 0.0), push(0.0, 0.0, 0.7), turn(0.3, 0.9, 0.0)}) {
      const SteerSettings settings{.fly = fly};
      RoomCamera fine = front;
      for (int i = 0; i < 60; ++i) fine = steered(fine, motion, settings, 1.0 / 60.0);
      RoomCamera coarse = front;
      for (int i = 0; i < 20; ++i) coarse = steered(coarse, motion, settings, 1.0 / 20.0);
      CHECK(apart(eye_of(fine), eye_of(coarse)) < 1e-9);
      CHECK(fine.azimuth_deg == doctest::Approx(coarse.azimuth_deg));
    }
  }
}

TEST_CASE("a light hand is slow, sensitivity and inversion do as they say, rest does nothing") {
  const double full = steered(front, turn(0, 1, 0), {}, 0.1).azimuth_deg;
  CHECK(steered(front, turn(0, 0.5, 0), {}, 0.1).azimuth_deg == doctest::Approx(0.25 * full));
  CHECK(steered(front, turn(0, -0.5, 0), {}, 0.1).azimuth_deg == doctest::Approx(-0.25 * full));
  CHECK(steered(front, turn(0, 1, 0), {.sensitivity = 3.0}, 0.1).azimuth_deg == doctest::Approx(3.0 * full));
  CHECK(steered(front, turn(0, 1, 0), {.invert_turn = true}, 0.1).azimuth_deg == doctest::Approx(-full));
  CHECK(steered(front, push(0, 0, 1), {.invert_push = true}, 0.1).distance_m > front.distance_m);
  CHECK(steered(front, {}, {}, 0.1) == front);
  CHECK(steered(front, push(1, 1, 1), {}, 0.0) == front);
}

TEST_CASE("the camera stays where it can see, however long it is pushed") {
  CHECK(steered(front, push(0, 0, 1), {}, 1000.0).distance_m == doctest::Approx(0.02));
  CHECK(steered(front, push(0, 0, -1), {}, 1000.0).distance_m == doctest::Approx(500.0));
  CHECK(steered(front, turn(1, 0, 0), {}, 1000.0).elevation_deg == 90.0);
}

TEST_CASE("things go with the hand along the view's axes, and turn about their middle") {
  const glm::dquat from_right = view_of({{}, 2.0, -90.0, 0.0}, size_px).world_from_camera.rotation;  // looks along -X
  const auto moved = carried({thing_at({1, 0, 0})}, from_right, 2.0, push(1, 0, 0), {}, 0.5);
  CHECK(apart(moved[0].pose.position_m, {1.0, 0.0, -1.0}) < 1e-12);  // its right is -Z
  const glm::dquat straight(1.0, 0.0, 0.0, 0.0);
  const auto nearer = carried({thing_at({0, 0, 0})}, straight, 4.0, push(0, 0, 1), {}, 0.25);
  CHECK(apart(nearer[0].pose.position_m, {0.0, 0.0, 1.0}) < 1e-12);  // fast, for it is far away
  HandleThing point = thing_at({-1, 0, 0});
  point.turns = false;
  const auto pair = carried({thing_at({1, 0, 0}), point}, straight, 1.0, turn(0, 1, 0), {}, 0.75);  // 90 degrees
  CHECK(apart(pair[0].pose.position_m, {0.0, 0.0, -1.0}) < 1e-12);
  CHECK(apart(pair[0].pose.direction({0, 0, 1}), {1.0, 0.0, 0.0}) < 1e-12);
  CHECK(apart(pair[1].pose.position_m, {0.0, 0.0, 1.0}) < 1e-12);
  CHECK(pair[1].pose.rotation == glm::dquat(1.0, 0.0, 0.0, 0.0));
  CHECK(carried({}, straight, 1.0, push(1, 0, 0), {}, 1.0).empty());
}
