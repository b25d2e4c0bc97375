#include "editor/tools/mesh_tree.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include <glm/geometric.hpp>

#include "core/stage/primitive_cache.h"

using namespace focalstage;

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// The nearest triangle by looking at all of them, by the signs of three volumes: another method than the tree's.
std::optional<TreeHit> by_hand(const Mesh& mesh, const glm::dvec3& o, const glm::dvec3& d) {
  std::optional<TreeHit> best;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::dvec3 a = mesh.positions_m[mesh.triangles[i].x] - o;
    const glm::dvec3 b = mesh.positions_m[mesh.triangles[i].y] - o;
    const glm::dvec3 c = mesh.positions_m[mesh.triangles[i].z] - o;
    const double u = glm::dot(d, glm::cross(b, c));
    const double v = glm::dot(d, glm::cross(c, a));
    const double w = glm::dot(d, glm::cross(a, b));
    if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) continue;
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double t = glm::dot(n, a) / glm::dot(n, d);
    if (t > 0.0 && (!best || t < best->t)) best = TreeHit{t, i};
  }
  return best;
}

}  // namespace

TEST_CASE("the tree finds what looking at every triangle finds") {
  const auto mesh = *primitive_mesh(RabbitMesh{});
  MeshTree tree(mesh);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 origin{2.0 * any(random), 0.5 + 2.0 * any(random), 2.0 * any(random)};
    const glm::dvec3 aim{0.3 * any(random), 0.5 + 0.5 * any(random), 0.3 * any(random)};
    const auto found = tree.first(origin, aim - origin, 0.0, endless);
    const auto expected = by_hand(*mesh, origin, aim - origin);
    REQUIRE(found.has_value() == expected.has_value());
    if (!found) continue;
    ++hits;
    CHECK(found->t == doctest::Approx(expected->t).epsilon(1e-9));
  }
  CHECK(hits > 100);
}

TEST_CASE("only what lies between the ends counts") {
  const auto box = *primitive_mesh(BoxMesh{{1.0, 1.0, 1.0}});
  MeshTree tree(box);
  const glm::dvec3 origin{0.1, 0.2, 2.0};
  const glm::dvec3 along{0.0, 0.0, -2.0};  // of length two: t counts in its length
  CHECK(tree.first(origin, along, 0.0, endless)->t == doctest::Approx(0.75));
  CHECK(tree.first(origin, along, 0.8, endless)->t == doctest::Approx(1.25));  // the back, from inside
  CHECK(!tree.first(origin, along, 0.8, 1.2));
  CHECK(!tree.first(origin, along, 1.3, endless));
}

TEST_CASE("rays in a box's own faces, meshes without triangles, many triangles in one place") {
  MeshTree empty(std::make_shared<Mesh>());
  CHECK(!empty.first({0, 0, 1}, {0, 0, -1}, 0.0, endless));

  const auto plane = *primitive_mesh(PlaneMesh{{2.0, 2.0}});
  MeshTree flat(plane);
  CHECK(flat.first({0.25, 0.5, 1.0}, {0, 0, -1}, 0.0, endless));
  CHECK(!flat.first({-5.0, 0.5, 0.0}, {1, 0, 0}, 0.0, endless));  // runs within the plane: an edge is no face

  auto heap = std::make_shared<Mesh>();
  heap->positions_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  heap->triangles.assign(5000, {0, 1, 2});
  MeshTree stacked(heap);
  CHECK(stacked.first({0.2, 0.2, 1.0}, {0, 0, -1}, 0.0, endless)->t == doctest::Approx(1.0));
}
