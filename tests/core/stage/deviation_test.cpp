#include "core/stage/deviation.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "core/mesh/primitives.h"
#include "core/process/process.h"
#include "core/stage/nearest_surface.h"

namespace focalstage {
namespace {

std::vector<Drawable> stood(Mesh mesh, double scale = 1.0, const glm::dvec3& at_m = glm::dvec3(0.0)) {
  glm::dmat4 matrix(scale);
  matrix[3] = glm::dvec4(at_m, 1.0);
  return {{std::make_shared<const Mesh>(std::move(mesh)), matrix, {}}};
}

}  // namespace

TEST_CASE("the nearest place of a triangle is that of all its places") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const auto point = [&] { return glm::dvec3(number(random), number(random), number(random)); };
  for (int round = 0; round < 200; ++round) {
    const NearestSurface::Triangle t{point(), point(), point()};
    const glm::dvec3 p = 2.0 * point();
    double least_m = 1e9;
    for (int i = 0; i <= 200; ++i) {
      for (int j = 0; i + j <= 200; ++j) {
        const glm::dvec3 at = t[0] + (i / 200.0) * (t[1] - t[0]) + (j / 200.0) * (t[2] - t[0]);
        least_m = std::min(least_m, glm::distance(p, at));
      }
    }
    const double found_m = distance_to_triangle_m(p, t);
    CHECK(found_m <= least_m + 1e-12);
    CHECK(found_m > least_m - 0.02);
  }
}

TEST_CASE("the tree finds what a look at every triangle finds, also of triangles without area") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const auto point = [&] { return glm::dvec3(number(random), number(random), number(random)); };
  std::vector<NearestSurface::Triangle> triangles;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 at = point();
    triangles.push_back({at, at + 0.1 * point(), i % 7 == 0 ? at : at + 0.1 * point()});
  }
  const NearestSurface surface(triangles);
  for (int round = 0; round < 300; ++round) {
    const glm::dvec3 p = 1.5 * point();
    double least_m = 1e9;
    for (const auto& t : triangles) least_m = std::min(least_m, distance_to_triangle_m(p, t));
    CHECK(surface.distance_m(p) == least_m);
  }
}

TEST_CASE("what moved is off by how far it moved, in the room's metres") {
  Mesh bent = make_plane({2, 2});
  bent.positions_m[0].z += 0.5;
  const glm::dvec3 aside(5, 0, 0);
  const Deviation deviation = deviation_of(stood(make_plane({2, 2}), 0.1, aside), stood(bent, 0.1, aside));
  CHECK(deviation.worst_m == doctest::Approx(0.05));
  CHECK(deviation.of_vertex_m.at(0).at(0) == doctest::Approx(0.05));
  CHECK(deviation.of_vertex_m.at(0).at(3) == doctest::Approx(0.0));
  const auto vertices = static_cast<double>(bent.positions_m.size());
  CHECK(deviation.mean_m == doctest::Approx(0.05 / vertices));
}

TEST_CASE("steps keep what they promise: decimation by its error, mapping not at all; what went is told") {
  const Mesh sphere = make_sphere(0.5);
  const auto after = [&](const ProcessKind& step) {
    return deviation_of(stood(sphere), stood(*processed(sphere, {{step, {}}})));
  };
  const Deviation coarse = after(DecimateStep{std::nullopt, 2.0});
  CHECK(coarse.worst_m < 1e-12);  // the vertices that are left stay
  CHECK(coarse.worst_lost_m > 0.2e-3);
  CHECK(coarse.worst_lost_m < 2.1e-3);
  const Deviation mapped = after(UvPlaneStep{});
  CHECK(std::max(mapped.worst_m, mapped.worst_lost_m) < 1e-12);
  const Mesh box = make_box({1, 1, 1});
  const Deviation face = deviation_of(stood(box), stood(*processed(box, {{KeepPartStep{0, 30.0}, {}}})));
  CHECK(face.worst_m < 1e-12);
  CHECK(face.worst_lost_m == doctest::Approx(1.0));
}

}  // namespace focalstage
