#include "editor/tools/room_camera.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

using namespace focalstage;

namespace {
const glm::dvec2 size_px{600.0, 400.0};

glm::dvec3 looks_along(const RoomCamera& camera) {
  return view_of(camera, size_px).world_from_camera.direction({0.0, 0.0, -1.0});
}
}  // namespace

TEST_CASE("azimuth 0 looks along -Z, 90 to the right, elevation 90 straight down") {
  CHECK(glm::length(looks_along({.azimuth_deg = 0.0, .elevation_deg = 0.0}) - glm::dvec3(0, 0, -1)) < 1e-12);
  CHECK(glm::length(looks_along({.azimuth_deg = 90.0, .elevation_deg = 0.0}) - glm::dvec3(1, 0, 0)) < 1e-12);
  CHECK(glm::length(looks_along({.azimuth_deg = 0.0, .elevation_deg = 90.0}) - glm::dvec3(0, -1, 0)) < 1e-12);
}

TEST_CASE("the target is in the middle of the picture, whatever the camera") {
  const RoomCamera camera{{0.3, 0.1, -0.7}, 2.5, 71.0, -33.0};
  const RoomView view = view_of(camera, size_px);
  CHECK(glm::length(*pixel_of(view, camera.target_m) - 0.5 * size_px) < 1e-9);
  CHECK(depth_m(view, camera.target_m) == doctest::Approx(2.5));
}

TEST_CASE("orbiting to the right carries what is in front to the right, downwards shows it from above") {
  const RoomCamera camera{{0, 0, 0}, 2.0, 20.0, 10.0};
  const glm::dvec3 in_front =
      camera.target_m - 0.3 * looks_along(camera);  // between camera and target, now in the middle
  const glm::dvec2 moved = *pixel_of(view_of(orbited(camera, {30.0, 0.0}), size_px), in_front);
  CHECK(moved.x > 0.5 * size_px.x + 5.0);
  CHECK(orbited(camera, {0.0, 30.0}).elevation_deg == doctest::Approx(22.0));
  CHECK(orbited(camera, {0.0, 1e6}).elevation_deg == 90.0);
  CHECK(orbited({.azimuth_deg = 179.0}, {10.0, 0.0}).azimuth_deg == doctest::Approx(-177.0));
}

TEST_CASE("panning keeps what lies at the target's depth under the hand") {
  const RoomCamera camera{{0.1, 0.2, -0.5}, 1.5, -35.0, 22.0};
  const glm::dvec2 before = *pixel_of(view_of(camera, size_px), camera.target_m);
  const RoomCamera moved = panned(camera, size_px, {40.0, -25.0});
  CHECK(glm::length(*pixel_of(view_of(moved, size_px), camera.target_m) - before - glm::dvec2(40.0, -25.0)) < 1e-9);
}

TEST_CASE("the wheel goes towards what is under the pointer") {
  const RoomCamera camera{{0, 0, 0}, 2.0, 0.0, 0.0};
  const glm::dvec2 pixel{450.0, 120.0};
  const Ray ray = ray_through(view_of(camera, size_px), pixel);
  const glm::dvec3 under = ray.at((0.0 - ray.origin_m.z) / ray.direction.z);  // in the target's plane z = 0
  const RoomCamera nearer = zoomed(camera, size_px, pixel, 3.0);
  CHECK(nearer.distance_m < camera.distance_m);
  CHECK(glm::length(*pixel_of(view_of(nearer, size_px), under) - pixel) < 1e-9);
  const RoomCamera back = zoomed(nearer, size_px, pixel, -3.0);
  CHECK(back.distance_m == doctest::Approx(camera.distance_m));
  CHECK(glm::length(back.target_m - camera.target_m) < 1e-9);
  CHECK(zoomed(camera, size_px, pixel, 1e4).distance_m > 0.0);
}

TEST_CASE("fitted bounds touch nine tenths of the picture and never leave it") {
  const Bounds bounds{{-0.4, -0.1, -1.0}, {0.6, 0.3, -0.2}};
  for (const double azimuth_deg : {0.0, 40.0, -120.0}) {
    const RoomView view = view_of(fitted({.azimuth_deg = azimuth_deg}, size_px, bounds), size_px);
    double reach = 0.0;
    for (int i = 0; i < 8; ++i) {
      const glm::dvec3 p{(i & 1) != 0 ? 0.6 : -0.4, (i & 2) != 0 ? 0.3 : -0.1, (i & 4) != 0 ? -0.2 : -1.0};
      const glm::dvec2 from_middle = (*pixel_of(view, p) - 0.5 * size_px) / (0.5 * size_px);
      reach = std::max({reach, std::abs(from_middle.x), std::abs(from_middle.y)});
    }
    CHECK(reach == doctest::Approx(0.9).epsilon(1e-6));
  }
  const RoomCamera camera;
  CHECK(fitted(camera, size_px, Bounds{}) == camera);
}

TEST_CASE("standard views") {
  CHECK(standard_view_named("left") == StandardView::left);
  CHECK(!standard_view_named("sideways"));
  CHECK(glm::length(looks_along(from_side({}, StandardView::left)) - glm::dvec3(1, 0, 0)) < 1e-12);
  CHECK(glm::length(looks_along(from_side({}, StandardView::right)) - glm::dvec3(-1, 0, 0)) < 1e-12);
  CHECK(glm::length(looks_along(from_side({}, StandardView::back)) - glm::dvec3(0, 0, 1)) < 1e-12);
  // From above, -Z is up in the picture.
  const RoomView top = view_of(from_side({{0, 0, 0}, 2.0}, StandardView::top), size_px);
  CHECK(pixel_of(top, {0.0, 0.0, -0.2})->y < 0.5 * size_px.y - 10.0);
}
