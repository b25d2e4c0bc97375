#include "editor/tools/room_view.h"

#include <doctest/doctest.h>

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

using namespace focalstage;

namespace {

RoomView some_view() {
  RoomView view;
  view.world_from_camera = {{0.3, -0.2, 1.1}, glm::normalize(glm::dquat(0.9, 0.1, -0.35, 0.05))};
  view.size_px = {640.0, 400.0};
  view.focal_px = {500.0, 510.0};
  view.centre_px = {300.0, 230.0};  // off the middle: a projector's shift
  view.near_m = 0.05;
  view.far_m = 20.0;
  return view;
}

}  // namespace

TEST_CASE("the ray through a point's pixel passes through the point") {
  const RoomView view = some_view();
  for (const glm::dvec3& from_camera : {glm::dvec3(0.2, 0.1, -0.8), glm::dvec3(-1.0, 0.5, -3.0)}) {
    const glm::dvec3 p = view.world_from_camera.point(from_camera);
    const auto pixel = pixel_of(view, p);
    REQUIRE(pixel);
    const Ray ray = ray_through(view, *pixel);
    CHECK(glm::length(ray.at(glm::length(from_camera)) - p) < 1e-12);
  }
}

TEST_CASE("up in the room is up in the picture, and what lies behind has no pixel") {
  RoomView view;
  view.size_px = {200.0, 100.0};
  view.focal_px = {100.0, 100.0};
  view.centre_px = {100.0, 50.0};
  const auto pixel = pixel_of(view, {0.5, 0.25, -1.0});
  REQUIRE(pixel);
  CHECK(*pixel == glm::dvec2(150.0, 25.0));
  CHECK(!pixel_of(view, {0.0, 0.0, 1.0}));
  CHECK(!pixel_of(view, {0.0, 0.0, -0.5 * view.near_m}));
}

TEST_CASE("the matrices land points on the same pixels, near and far on -1 and 1") {
  const RoomView view = some_view();
  const glm::dmat4 clip_from_world = clip_from_camera(view) * camera_from_world(view);
  const glm::dvec3 p = view.world_from_camera.point({0.3, -0.4, -2.0});
  const glm::dvec4 clip = clip_from_world * glm::dvec4(p, 1.0);
  const glm::dvec2 screen = glm::dvec2(clip.x / clip.w + 1.0, 1.0 - clip.y / clip.w) * 0.5 * view.size_px;
  CHECK(glm::length(screen - *pixel_of(view, p)) < 1e-9);
  const auto depth = [&](double z_m) {
    const glm::dvec4 c = clip_from_camera(view) * glm::dvec4(0.0, 0.0, -z_m, 1.0);
    return c.z / c.w;
  };
  CHECK(depth(view.near_m) == doctest::Approx(-1.0));
  CHECK(depth(view.far_m) == doctest::Approx(1.0));
}

TEST_CASE("a pixel covers depth over focal length metres") {
  RoomView view;
  view.focal_px = {100.0, 200.0};
  CHECK(metres_per_px(view, {0.0, 0.0, -3.0}) == doctest::Approx(0.015));
  CHECK(metres_per_px(view, {0.0, 0.0, 3.0}) == doctest::Approx(view.near_m / 200.0));  // behind: never zero
}

TEST_CASE("through the eye, the field of view spans the picture's width") {
  Eye eye;
  eye.eye_from_world = Rigid{{0.1, 0.2, 0.3}}.inverse();
  const RoomView view = eye_view(eye, {400.0, 300.0}, 90.0);
  const auto edge = pixel_of(view, {0.1 + 1.0, 0.2, 0.3 - 1.0});  // 45 degrees to the right
  REQUIRE(edge);
  CHECK(edge->x == doctest::Approx(400.0));
  CHECK(edge->y == doctest::Approx(150.0));
}

TEST_CASE("through the projector, its whole picture lies inside with bars beside it") {
  ProjectorModel projector;
  projector.width_px = 1000;
  projector.height_px = 500;
  projector.focal_px = {1200.0, 1200.0};
  projector.centre_px = {500.0, 600.0};  // its axis leaves the picture below: an ordinary lens shift
  const RoomView view = projector_view(projector, {300.0, 300.0});
  const auto top_left = [&](double x, double y) {
    const glm::dvec2 t = (glm::dvec2(x, y) - projector.centre_px) / projector.focal_px;
    return *pixel_of(view, {t.x, -t.y, -1.0});
  };
  // 0.3 screen pixels per projector pixel, bars of 75 above and below.
  CHECK(glm::length(top_left(0.0, 0.0) - glm::dvec2(0.0, 75.0)) < 1e-9);
  CHECK(glm::length(top_left(1000.0, 500.0) - glm::dvec2(300.0, 225.0)) < 1e-9);
}
