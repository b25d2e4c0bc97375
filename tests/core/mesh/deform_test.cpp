#include "core/mesh/deform.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

using namespace focalstage;

namespace {

Mesh triangle() {
  Mesh mesh;
  mesh.positions_m = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

/// Vertex 0 on joint 0, vertex 1 on joint 1, vertex 2 a quarter on 0 and three on 1.
Deformation skinned() {
  Deformation deformation;
  deformation.shares = {{0, 1.0}, {1, 1.0}, {0, 0.25}, {1, 0.75}};
  deformation.first_share = {0, 1, 2, 4};
  return deformation;
}

constexpr double tolerance = 1e-15;

bool near(const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b) < tolerance; }

}  // namespace

TEST_CASE("morph targets add up by their weights, and what they do not name stays") {
  Deformation deformation;
  deformation.targets = {{{1}, {{1, 2, 3}}, {}}, {{0, 1}, {{0, 0, 4}, {10, 0, 0}}, {{1, 0, -1}, {0, 3, 0}}}};
  const double weights[] = {2.0, -0.5};
  const Mesh moved = deformed(triangle(), deformation, weights, {});
  CHECK(moved.positions_m == std::vector<glm::dvec3>{{0, 0, -2}, {2 + 2 - 5, 4, 6}, {0, 1, 0}});
  // (0,0,1) - (1,0,-1)/2 = (-0.5,0,1.5); (0,0,1) - (0,3,0)/2 = (0,-1.5,1): of unit length.
  CHECK(near(moved.normals[0], glm::dvec3(-1, 0, 3) / std::sqrt(10.0)));
  CHECK(near(moved.normals[1], glm::dvec3(0, -3, 2) / std::sqrt(13.0)));
  CHECK(moved.normals[2] == glm::dvec3(0, 0, 1));
  CHECK(moved.uvs == triangle().uvs);
  CHECK(moved.triangles == triangle().triangles);
  const double none[] = {0.0, 0.0};
  CHECK(deformed(triangle(), deformation, none, {}) == triangle());
}

TEST_CASE("joints carry vertices by their shares, after the morph targets") {
  // Joint 0 stands; joint 1 turns by 90 degrees about X and then moves up by 2: (x,y,z) to (x,2-z,y).
  const glm::dmat4 turn(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, 1, 0), glm::dvec4(0, -1, 0, 0),
                        glm::dvec4(0, 2, 0, 1));
  const glm::dmat4 joints[] = {glm::dmat4(1.0), turn};
  Deformation deformation = skinned();
  deformation.targets = {{{1}, {{0, 0, 5}}, {}}};
  const double weights[] = {1.0};
  const Mesh moved = deformed(triangle(), deformation, weights, joints);
  CHECK(moved.positions_m[0] == glm::dvec3(0, 0, 0));
  CHECK(near(moved.positions_m[1], {2, 2 - 5, 0}));  // (2,0,5) turned and moved
  CHECK(near(moved.positions_m[2], 0.25 * glm::dvec3(0, 1, 0) + 0.75 * glm::dvec3(0, 2, 1)));
  CHECK(near(moved.normals[0], {0, 0, 1}));
  CHECK(near(moved.normals[1], {0, -1, 0}));
  // Without joints the shares mean nothing.
  CHECK(deformed(triangle(), skinned(), {}, {}) == triangle());
}

TEST_CASE("normals stay square to what stretches, on the same side of what is mirrored") {
  // The face x + z = 0 with its normal, stretched by 4 along X: the face x/4 + z = 0.
  Mesh slope;
  slope.positions_m = {{0, 0, 0}, {1, 0, -1}, {0, 1, 0}};
  slope.normals.assign(3, glm::normalize(glm::dvec3(1, 0, 1)));
  slope.triangles = {{0, 1, 2}};
  Deformation deformation;
  deformation.shares = {{0, 1.0}, {0, 1.0}, {0, 1.0}};
  deformation.first_share = {0, 1, 2, 3};
  for (const double mirror : {1.0, -1.0}) {
    const glm::dmat4 joints[] = {glm::scale(glm::dmat4(1.0), glm::dvec3(4, mirror, 1))};
    const Mesh moved = deformed(slope, deformation, {}, joints);
    const glm::dvec3 edge = moved.positions_m[1] - moved.positions_m[0];
    CHECK(std::abs(glm::dot(moved.normals[0], edge)) < tolerance);
    CHECK(glm::length(moved.normals[0]) == doctest::Approx(1.0));
    CHECK(std::abs(moved.normals[0].x) == doctest::Approx(1 / std::sqrt(17.0)));
  }
}

TEST_CASE("a vertex that no number comes of stays where it was") {
  const double infinity = std::numeric_limits<double>::infinity();
  const glm::dmat4 joints[] = {glm::scale(glm::dmat4(1.0), glm::dvec3(infinity)), glm::dmat4(0.0)};
  const Mesh moved = deformed(triangle(), skinned(), {}, joints);
  CHECK(moved.positions_m[0] == glm::dvec3(0, 0, 0));
  CHECK(moved.positions_m[1] == glm::dvec3(0, 0, 0));  // flat, which is a number
  for (const glm::dvec3& normal : moved.normals) CHECK(normal == glm::dvec3(0, 0, 1));
}
