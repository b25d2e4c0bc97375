#include "editor/tools/outline.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/stage/primitive_cache.h"

using namespace focalstage;

namespace {

RoomView view_100() {
  RoomView view;
  view.size_px = {200.0, 150.0};
  view.focal_px = {100.0, 100.0};
  view.centre_px = {100.0, 75.0};
  return view;
}

double enclosed(const Outline& outline) {
  double doubled = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2& a = outline[i];
    const glm::dvec2& b = outline[(i + 1) % outline.size()];
    doubled += a.x * b.y - a.y * b.x;
  }
  return std::abs(0.5 * doubled);
}

}  // namespace

TEST_CASE("a ball's outline is a circle") {
  // Half a metre at 2 m: the tangent cone's half angle has the sine 1/4, so the radius is 100 px / sqrt(15).
  const Drawable ball{*primitive_mesh(SphereMesh{0.5}), glm::translate(glm::dmat4(1.0), {0, 0, -2.0}), {}};
  const auto found = outlines(view_100(), {ball});
  REQUIRE(found.size() == 1);
  for (const glm::dvec2& point : found[0]) {
    CHECK(std::abs(glm::length(point - glm::dvec2(100.0, 75.0)) - 100.0 / std::sqrt(15.0)) < 1.2);
  }
}

TEST_CASE("two apart have two outlines, two that overlap have one") {
  const auto box = [](double x) {
    return Drawable{*primitive_mesh(BoxMesh{glm::dvec3(0.4)}), glm::translate(glm::dmat4(1.0), {x, 0, -2.0}), {}};
  };
  CHECK(outlines(view_100(), {box(-0.6), box(0.6)}).size() == 2);
  CHECK(outlines(view_100(), {box(-0.1), box(0.1)}).size() == 1);
}

TEST_CASE("only what is in the picture and before the camera counts") {
  const auto plane = *primitive_mesh(PlaneMesh{{50.0, 50.0}});
  const auto all = outlines(view_100(), {{plane, glm::translate(glm::dmat4(1.0), {0, 0, -1.0}), {}}});
  REQUIRE(all.size() == 1);
  CHECK(enclosed(all[0]) > 199.0 * 149.0);  // to the picture's edge, and a pixel beyond at most
  CHECK(enclosed(all[0]) < 202.0 * 152.0);
  CHECK(outlines(view_100(), {{plane, glm::translate(glm::dmat4(1.0), {0, 0, 1.0}), {}}}).empty());
  CHECK(outlines(view_100(), {}).empty());
}

TEST_CASE("coarser cells give the same outline within a cell") {
  const Drawable box{*primitive_mesh(BoxMesh{glm::dvec3(0.4)}), glm::translate(glm::dmat4(1.0), {0, 0, -2.0}), {}};
  const double fine = enclosed(outlines(view_100(), {box})[0]);
  const double coarse = enclosed(outlines(view_100(), {box}, 2.0)[0]);
  CHECK(std::abs(std::sqrt(fine) - std::sqrt(coarse)) < 2.5);
}
