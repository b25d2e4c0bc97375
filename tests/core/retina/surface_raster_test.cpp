#include "core/retina/surface_raster.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/core/retina/rig.h"

using namespace focalstage;
using namespace focalstage::retina_test;

namespace {

LookGrid grid_of_side(int side_px, double half) {
  const double step = 2.0 * half / side_px;
  return {side_px, side_px, {-half + 0.5 * step, half - 0.5 * step}, {step, -step}};
}

/// The nearest of all faces, by the shortest way: solve for the corners' shares.
std::uint32_t nearest_by_hand(const SurfaceMesh& mesh, const Rigid& view_from_world, const glm::dvec2& look,
                              double& depth_m) {
  std::uint32_t best = SurfaceRaster::nothing;
  depth_m = 1e30;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const glm::dvec3 a = view_from_world.point(mesh.points_m[mesh.faces[i].x]);
    const glm::dvec3 ab = view_from_world.point(mesh.points_m[mesh.faces[i].y]) - a;
    const glm::dvec3 ac = view_from_world.point(mesh.points_m[mesh.faces[i].z]) - a;
    const glm::dmat3 m(ab, ac, -glm::dvec3(look, -1.0));
    if (std::abs(glm::determinant(m)) < 1e-15) continue;
    const glm::dvec3 solved = glm::inverse(m) * -a;
    if (solved.x < 0.0 || solved.y < 0.0 || solved.x + solved.y > 1.0 || solved.z < 1e-3 || solved.z >= depth_m) {
      continue;
    }
    depth_m = solved.z;
    best = static_cast<std::uint32_t>(i);
  }
  return best;
}

}  // namespace

TEST_CASE("each pixel has the nearest face, also where faces reach behind the viewpoint") {
  const std::vector<StagedSurface> surfaces = {
      support::surface_of(support::standing(support::blob(0.3, 6, 0.4, 5), {{0.1, 0.0, -0.9}, {1, 0, 0, 0}})),
      support::surface_of(support::standing(support::rectangle({3.0, 3.0}),
                                            {{0.0, -0.3, 0.2}, glm::angleAxis(-1.4, glm::dvec3(1.0, 0.0, 0.0))}))};
  const SurfaceMesh mesh = surface_mesh(surfaces);
  const Rigid view_from_world = support::looking({0.1, 0.2, 0.1}, {0.0, -0.1, -0.9}, 0.2).inverse();
  const LookGrid grid = grid_of_side(60, 1.1);
  const SurfaceRaster raster = raster_surfaces(mesh, view_from_world, grid, 1e-3, {});
  int seen = 0, empty = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      double depth_m = 0.0;
      const glm::dvec2 look = grid.look(x, y);
      const std::uint32_t expected = nearest_by_hand(mesh, view_from_world, look, depth_m);
      REQUIRE(raster.at(x, y) == expected);
      if (expected == SurfaceRaster::nothing) {
        ++empty;
        continue;
      }
      ++seen;
      CHECK(1.0 / raster.faces[expected].inverse_depth(look) == doctest::Approx(depth_m).epsilon(1e-9));
      CHECK(raster.faces[expected].covers(look));
    }
  }
  CHECK(seen > 500);
  CHECK(empty > 500);
}

TEST_CASE("nothing slips between neighbours") {
  // Corners on pixel centres and edges along rows and columns, seen square: the worst case for rounding.
  const auto sheet = support::sheet(32, 32, [](double u, double v) { return glm::dvec3(u - 0.5, v - 0.5, 0.0); });
  for (const double away_m : {0.5, 0.7, 1.0 / 3.0}) {
    const SurfaceMesh mesh =
        surface_mesh({support::surface_of(support::standing(sheet, {{0.0, 0.0, -away_m}, {1, 0, 0, 0}}))});
    const LookGrid grid{65, 65, glm::dvec2(-0.4, 0.4) / away_m, glm::dvec2(0.0125, -0.0125) / away_m};
    const SurfaceRaster raster = raster_surfaces(mesh, {}, grid, 1e-3, {});
    for (const std::uint32_t face : raster.nearest) REQUIRE(face != SurfaceRaster::nothing);
  }
}

TEST_CASE("nearer than the nearest nothing is seen") {
  const SurfaceMesh mesh = surface_mesh(
      {support::surface_of(support::standing(support::rectangle({9.0, 9.0}), {{0.0, 0.0, -0.1}, {1, 0, 0, 0}})),
       support::surface_of(support::standing(support::rectangle({9.0, 9.0}), {{0.0, 0.0, -0.2}, {1, 0, 0, 0}}))});
  const LookGrid grid = grid_of_side(8, 0.5);
  CHECK(raster_surfaces(mesh, {}, grid, 0.05, {}).at(3, 3) <= 1);
  CHECK(raster_surfaces(mesh, {}, grid, 0.15, {}).at(3, 3) >= 2);
  CHECK(raster_surfaces(mesh, {}, grid, 0.25, {}).at(3, 3) == SurfaceRaster::nothing);
}
