#include "core/mesh/primitives.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>

#include <glm/geometric.hpp>

#include "core/mesh/circle.h"
#include "core/mesh/measure.h"
#include "core/mesh/smooth_parts.h"

using namespace focalstage;

namespace {

bool near(const glm::dvec3& a, const glm::dvec3& b, double within = 1e-14) { return glm::length(a - b) < within; }

/// The front side must be the one that the normals name.
double worst_agreement(const Mesh& mesh) {
  double worst = 1.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 area = doubled_area(mesh.positions_m[t.x], mesh.positions_m[t.y], mesh.positions_m[t.z]);
    REQUIRE(glm::length(area) > 0.0);
    for (int i = 0; i < 3; ++i) worst = std::min(worst, glm::dot(glm::normalize(area), mesh.normals[t[i]]));
  }
  return worst;
}

/// The surface's point at `uv`, searched in all triangles.
glm::dvec3 point_at(const Mesh& mesh, const glm::dvec2& uv) {
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec2 a = mesh.uvs[t.x];
    const glm::dvec2 ab = mesh.uvs[t.y] - a;
    const glm::dvec2 ac = mesh.uvs[t.z] - a;
    const double area = ab.x * ac.y - ab.y * ac.x;
    const glm::dvec2 d = uv - a;
    const double b = (d.x * ac.y - d.y * ac.x) / area;
    const double c = (ab.x * d.y - ab.y * d.x) / area;
    if (b < -1e-12 || c < -1e-12 || b + c > 1 + 1e-12) continue;
    return (1 - b - c) * mesh.positions_m[t.x] + b * mesh.positions_m[t.y] + c * mesh.positions_m[t.z];
  }
  FAIL("no triangle has this uv");
  return {};
}

}  // namespace

TEST_CASE("every primitive is valid, unit-normalled and wound towards its normals") {
  for (const Mesh& mesh : {make_plane({1.2, 0.8}), make_box({1, 2, 3}), make_sphere(0.3), make_corner({1, 2}, 70),
                           make_corner({1, 1}, 250), make_step({1, 1}, 0.2), make_step({1, 1}, -0.2)}) {
    CHECK(check_mesh(mesh).ok());
    CHECK(mesh.uvs.size() == mesh.positions_m.size());
    for (const glm::dvec3& normal : mesh.normals) CHECK(glm::length(normal) == doctest::Approx(1.0).epsilon(1e-14));
    CHECK(worst_agreement(mesh) > 0.99);
  }
}

TEST_CASE("the plane stands in XY, faces +Z, and is unrolled from its lower left corner") {
  const Mesh plane = make_plane({1.2, 0.8});
  CHECK(mesh_area_m2(plane) == doctest::Approx(0.96).epsilon(1e-15));
  CHECK(near(point_at(plane, {0, 0}), {-0.6, -0.4, 0}));
  CHECK(near(point_at(plane, {1, 0}), {0.6, -0.4, 0}));
  CHECK(near(point_at(plane, {0, 1}), {-0.6, 0.4, 0}));
  CHECK(near(point_at(plane, {0.25, 0.5}), {-0.3, 0, 0}));
  for (const glm::dvec3& normal : plane.normals) CHECK(normal == glm::dvec3(0, 0, 1));
}

TEST_CASE("the box is closed, of its size, and upright on every side") {
  const Mesh box = make_box({1, 2, 3});
  CHECK(is_closed(box));
  CHECK(enclosed_volume_m3(box) == doctest::Approx(6.0).epsilon(1e-15));
  CHECK(mesh_bounds(box).min_m == glm::dvec3(-0.5, -1, -1.5));
  CHECK(mesh_bounds(box).max_m == glm::dvec3(0.5, 1, 1.5));
  CHECK(smooth_parts(box).area_m2.size() == 6);
  for (std::size_t i = 0; i < box.positions_m.size(); ++i) {
    if (box.normals[i].y == 0.0) CHECK((box.uvs[i].y == 1.0) == (box.positions_m[i].y > 0.0));
    if (box.normals[i].z == 1.0) CHECK((box.uvs[i].x == 1.0) == (box.positions_m[i].x > 0.0));
  }
}

TEST_CASE("the sphere is closed, lies on its radius, and unrolls from -Z eastwards") {
  const Mesh sphere = make_sphere(0.25);
  CHECK(is_closed(sphere));
  for (const glm::dvec3& p : sphere.positions_m) CHECK(glm::length(p) == doctest::Approx(0.25).epsilon(1e-14));
  // 4/3 pi r^3, less what the chords cut off.
  CHECK(enclosed_volume_m3(sphere) == doctest::Approx(4.0 / 3.0 * pi / 64.0).epsilon(2e-3));
  CHECK(smooth_parts(sphere).area_m2.size() == 1);
  CHECK(near(point_at(sphere, {0.5, 0.5}), {0, 0, 0.25}));
  CHECK(near(point_at(sphere, {0.75, 0.5}), {0.25, 0, 0}));
  CHECK(near(point_at(sphere, {0.25, 0.5}), {-0.25, 0, 0}));
  CHECK(near(point_at(sphere, {0.5 + 0.5 / 128, 1.0}), {0, 0.25, 0}));
}

TEST_CASE("the corner folds along Y and opens towards +Z") {
  const Mesh corner = make_corner({2, 1}, 90);
  const double leg = std::sqrt(2.0);  // 2 m at 45 degrees
  CHECK(near(point_at(corner, {0, 0}), {-leg, -0.5, leg}));
  CHECK(near(point_at(corner, {0.5, 0.5}), {0, 0, 0}));
  CHECK(near(point_at(corner, {1, 1}), {leg, 0.5, leg}));
  CHECK(near(corner.normals[0], {1 / leg, 0, 1 / leg}));
  CHECK(smooth_parts(corner).area_m2.size() == 2);
  CHECK(mesh_area_m2(corner) == doctest::Approx(4.0));

  const Mesh flat = make_corner({1, 1}, 180);
  CHECK(near(point_at(flat, {0.25, 0.5}), {-0.5, 0, 0}));
  CHECK(smooth_parts(flat).area_m2.size() == 1);
  // Beyond 180 degrees it is the outside of an edge: the wings fall back.
  CHECK(point_at(make_corner({1, 1}, 270), {0, 0}).z < -0.5);
}

TEST_CASE("the step's right half lies back by its depth behind a wall") {
  const Mesh step = make_step({2, 1}, 0.5);
  CHECK(near(point_at(step, {0, 0}), {-1, -0.5, 0}));
  // 1 m left half, 0.5 m wall, 1 m right half.
  CHECK(near(point_at(step, {0.4, 0.5}), {0, 0, 0}));
  CHECK(near(point_at(step, {0.5, 0.5}), {0, 0, -0.25}));
  CHECK(near(point_at(step, {0.6, 0.5}), {0, 0, -0.5}));
  CHECK(near(point_at(step, {1, 1}), {1, 0.5, -0.5}));
  CHECK(smooth_parts(step).area_m2.size() == 3);
  CHECK(step.normals[4] == glm::dvec3(1, 0, 0));
  CHECK(make_step({2, 1}, -0.5).normals[4] == glm::dvec3(-1, 0, 0));
  CHECK(make_step({2, 1}, 0.0).triangles.size() == 4);
}

TEST_CASE("the teapot is Newell's") {
  const Mesh teapot = make_teapot();
  CHECK(check_mesh(teapot).ok());
  CHECK(teapot.triangles.size() == 6320);  // 32 patches of 200, less 10 at each of the eight poles of knob and bottom
  CHECK(worst_agreement(teapot) > -0.01);
  const Bounds bounds = mesh_bounds(teapot);
  CHECK(bounds.min_m.y == 0.0);
  CHECK(bounds.max_m.y == 1.0);
  // Body radius 2 over height 3.15. The handle's back is the control line x = -3 pulled by its cubic.
  CHECK(bounds.max_m.x == doctest::Approx(2.0 / 3.15).epsilon(1e-12));
  CHECK(bounds.min_m.x == doctest::Approx(-2.0 / 3.15).epsilon(1e-12));
  CHECK(bounds.min_m.z == doctest::Approx(-3.0 / 3.15).epsilon(1e-12));
  CHECK(bounds.max_m.z > 3.4 / 3.15);
  CHECK(bounds.max_m.z < 3.525 / 3.15);
  // Known points of the original: the rim's outer edge at x = 1.5, z = 2.4; the spout's opening at 2.8, 2.4.
  const auto has = [&](const glm::dvec3& original) {
    const glm::dvec3 ours = glm::dvec3(original.y, original.z, original.x) / 3.15;
    return std::any_of(teapot.positions_m.begin(), teapot.positions_m.end(),
                       [&](const glm::dvec3& p) { return near(p, ours); });
  };
  CHECK(has({1.5, 0, 2.4}));
  CHECK(has({0, -1.5, 2.4}));
  CHECK(has({2.8, 0, 2.4}));
  CHECK(has({3.2, 0, 2.4}));
  CHECK(has({-2.7, 0, 1.8}));
  CHECK(has({0, 0, 3.15}));
}

TEST_CASE(
    "the teapot's patches join without a gap: lid, body, handle and spout each end only where the original does") {
  const Mesh teapot = make_teapot();
  const std::vector<std::uint32_t> welded = welded_indices(teapot);
  std::multiset<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const glm::uvec3& t : teapot.triangles) {
    for (int i = 0; i < 3; ++i) edges.emplace(std::minmax(welded[t[i]], welded[t[(i + 1) % 3]]));
  }
  std::size_t open = 0;
  for (const auto& edge : edges) open += edges.count(edge) == 1;
  // The lid's edge and the rim's inner one (40 segments each), both ends of the handle and of the spout (20 each).
  CHECK(open == 2 * 40 + 4 * 20);
}

TEST_CASE("the rabbit is closed, smooth and stands") {
  const Mesh rabbit = make_rabbit();
  CHECK(check_mesh(rabbit).ok());
  CHECK(rabbit.triangles.size() >= 20000);
  CHECK(is_closed(rabbit));
  CHECK(worst_agreement(rabbit) > 0.0);
  const Bounds bounds = mesh_bounds(rabbit);
  CHECK(bounds.min_m.y == 0.0);
  CHECK(bounds.max_m.y == doctest::Approx(1.0).epsilon(1e-15));
  CHECK(bounds.max_m.x == doctest::Approx(-bounds.min_m.x).epsilon(0.01));
  // One body: V - E + F = 2 - 2 loops, with E = 3 F / 2. On either side the hind foot touches the forepaw: two loops.
  const std::vector<std::uint32_t> welded = welded_indices(rabbit);
  const auto vertices = static_cast<long>(std::set<std::uint32_t>(welded.begin(), welded.end()).size());
  const auto faces = static_cast<long>(rabbit.triangles.size());
  CHECK(vertices - faces / 2 == -2);
  const SmoothParts parts = smooth_parts(rabbit);
  CHECK(*std::max_element(parts.area_m2.begin(), parts.area_m2.end()) > 0.999 * mesh_area_m2(rabbit));
  for (std::size_t i = 0; i < rabbit.uvs.size(); ++i) {
    CHECK(rabbit.uvs[i] == glm::dvec2(rabbit.positions_m[i].x + 0.5, rabbit.positions_m[i].y));
  }
  CHECK(rabbit == make_rabbit());
}
