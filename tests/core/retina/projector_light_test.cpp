#include "core/retina/projector_light.h"

#include <doctest/doctest.h>

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "tests/core/retina/rig.h"
#include "tests/support/chance.h"

using namespace focalstage;
using namespace focalstage::retina_test;

namespace {

/// Whether another face stands before the spot, by the shortest way.
bool hidden_by_hand(const SurfaceMesh& mesh, const glm::dvec3& from_m, const glm::dvec3& spot_m, std::size_t own) {
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    if (i == own) continue;
    const glm::dvec3 a = mesh.points_m[mesh.faces[i].x];
    const glm::dvec3 ab = mesh.points_m[mesh.faces[i].y] - a, ac = mesh.points_m[mesh.faces[i].z] - a;
    const glm::dmat3 m(ab, ac, from_m - spot_m);
    if (std::abs(glm::determinant(m)) < 1e-18) continue;
    const glm::dvec3 solved = glm::inverse(m) * (from_m - a);
    if (solved.x >= 0.0 && solved.y >= 0.0 && solved.x + solved.y <= 1.0 && solved.z > 0.0 && solved.z < 1.0 - 1e-3) {
      return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("spots of boxes and waves are lit where nothing stands before them") {
  const ProjectorModel projector = projector_at({0.2, 0.3, 0.3}, 700.0, 640, 480);
  const Rigid standing{{0.0, 0.0, -0.4}, glm::angleAxis(0.3, glm::dvec3(0.3, 1.0, 0.0))};
  const std::vector<StagedSurface> surfaces = {
      support::surface_of(support::standing(support::box({0.1, 0.15, 0.08}), standing)),
      support::surface_of(
          support::standing(support::bumpy({0.8, 0.6}, 0.04, 24, 2.0), {{0.0, 0.0, -0.6}, {1, 0, 0, 0}}))};
  const SurfaceMesh mesh = surface_mesh(surfaces);
  const ProjectorLight light(mesh, projector, {});
  support::Chance chance(7);
  int lit = 0, dark = 0, wrong = 0;
  for (int i = 0; i < 40000; ++i) {
    const auto face = static_cast<std::uint32_t>(chance.whole(0, static_cast<int>(mesh.faces.size()) - 1));
    double u = chance.between(0.0, 1.0), v = chance.between(0.0, 1.0);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const glm::dvec3 a = mesh.points_m[mesh.faces[face].x];
    const glm::dvec3 spot_m =
        a + u * (mesh.points_m[mesh.faces[face].y] - a) + v * (mesh.points_m[mesh.faces[face].z] - a);
    const glm::dvec3 seen_m = light.projector_from_world().point(spot_m);
    const glm::dvec2 expected_px = pixel_of_tangent(projector, glm::dvec2(seen_m) / -seen_m.z);
    if (expected_px.x < 1.0 || expected_px.y < 1.0 || expected_px.x > 639.0 || expected_px.y > 479.0) continue;
    // As from a viewpoint 2 m away: what counts is the direction, and how far.
    const auto pixel = light.pixel(seen_m / 2.0, 0.5, face);
    const bool hidden = hidden_by_hand(mesh, projector.world_from_projector.position_m, spot_m, face);
    ++(hidden ? dark : lit);
    wrong += hidden == pixel.has_value() ? 1 : 0;
    if (pixel) CHECK(glm::length(*pixel - expected_px) < 1e-6);
  }
  MESSAGE(lit << " lit, " << dark << " dark, " << wrong << " wrong");
  CHECK(lit > 10000);
  CHECK(dark > 1000);
  CHECK(wrong <= 8);  // slivers between two pixels' centres
}

TEST_CASE("no pixel lights what lies outside the image or behind the projector") {
  const SurfaceMesh mesh = surface_mesh(
      {support::surface_of(support::standing(support::rectangle({9.0, 9.0}), {{0.0, 0.0, -1.0}, {1, 0, 0, 0}}))});
  ProjectorModel projector = projector_at({}, 100.0, 100, 80);
  projector.world_from_projector = {};
  projector.distortion = {-0.3, 0.0, 0.0, 0.0, 0.0};  // folds back: r (1 - 0.3 r^2) is zero again at r = 1.826
  const ProjectorLight light(mesh, projector, {});
  CHECK(light.pixel({0.1, 0.1, -1.0}, 1.0, 0).has_value());
  CHECK_FALSE(light.pixel({1.82, 0.0, -1.0}, 1.0, 0));
  CHECK_FALSE(light.pixel({0.1, 0.1, 1.0}, 1.0, 0));
}
