#include "core/mesh/smooth_parts.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/mesh/measure.h"
#include "core/mesh/primitives.h"

using namespace focalstage;

namespace {

/// Two unit squares that share an edge without sharing vertices; `second_flipped` winds the second the other way.
Mesh hinge(double turn_deg, bool second_flipped = false) {
  Mesh mesh = make_corner({1, 1}, 180.0 - turn_deg);
  if (second_flipped) {
    for (std::size_t i = 2; i < 4; ++i) std::swap(mesh.triangles[i].x, mesh.triangles[i].y);
  }
  return mesh;
}

}  // namespace

TEST_CASE("parts end where planes meet at 30 degrees, whatever way triangles wind") {
  for (const bool flipped : {false, true}) {
    CHECK(smooth_parts(hinge(29.9, flipped)).area_m2.size() == 1);
    CHECK(smooth_parts(hinge(30.1, flipped)).area_m2.size() == 2);
    CHECK(smooth_parts(hinge(150.0, flipped)).area_m2.size() == 2);
  }
}

TEST_CASE("a part's centre is weighted by area") {
  // An L of three triangles in one plane: a 2 x 1 rectangle and the half of a unit square on its left end.
  Mesh mesh;
  mesh.positions_m = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {0, 2, 0}, {9, 9, 9}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}};
  const SmoothParts parts = smooth_parts(mesh);
  REQUIRE(parts.area_m2.size() == 1);
  CHECK(parts.area_m2[0] == doctest::Approx(3.0));
  // (2 * (1, 0.5) + 1 * (2/3, 4/3)) / 3
  CHECK(glm::length(parts.centre_m[0] - glm::dvec3(8.0 / 9, 7.0 / 9, 0)) < 1e-15);

  glm::dmat4 matrix = glm::translate(glm::dmat4(1.0), glm::dvec3(1, 2, 3));
  matrix = glm::scale(matrix, glm::dvec3(2.0));
  const SmoothParts in_world = placed(parts, mesh, matrix);
  CHECK(in_world.part_of_triangle == parts.part_of_triangle);
  CHECK(in_world.area_m2[0] == doctest::Approx(12.0));
  CHECK(glm::length(in_world.centre_m[0] - (glm::dvec3(1, 2, 3) + 2.0 * parts.centre_m[0])) < 1e-14);
}

TEST_CASE("parts are numbered by their first triangle") {
  const Mesh box = make_box({1, 1, 1});
  const SmoothParts parts = smooth_parts(box);
  CHECK(parts.part_of_triangle == std::vector<std::uint32_t>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5});
}

TEST_CASE("triangles without area, doubled ones and an empty mesh are no trouble") {
  CHECK(smooth_parts(Mesh{}).area_m2.empty());
  Mesh mesh = make_plane({1, 1});
  mesh.triangles.emplace_back(0, 0, 1);
  mesh.triangles.emplace_back(0, 1, 1);
  const SmoothParts parts = smooth_parts(mesh);
  CHECK(parts.area_m2.size() == 3);
  CHECK(parts.area_m2[1] == 0.0);
  CHECK(std::isfinite(parts.centre_m[1].x));
  // A hundred thousand triangles on one edge are one fold and no hour of pairing.
  Mesh fan;
  fan.positions_m = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  fan.triangles.assign(100000, {0, 1, 2});
  CHECK(smooth_parts(fan).area_m2.size() == 100000);
}
