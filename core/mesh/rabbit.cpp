#include <algorithm>
#include <vector>

#include "core/mesh/implicit.h"
#include "core/mesh/isosurface.h"
#include "core/mesh/measure.h"
#include "core/mesh/primitives.h"

namespace focalstage {
namespace {

/// It sits on its haunches, forepaws before it, ears up and a little apart.
std::vector<Ellipsoid> rabbit_parts() {
  return {
      {.centre_m = {0.0, 0.25, -0.08}, .radius_m = {0.175, 0.20, 0.23}, .tilt_deg = {-20, 0}},                 // body
      {.centre_m = {0.0, 0.33, 0.08}, .radius_m = {0.125, 0.18, 0.12}, .tilt_deg = {12, 0}, .blend_m = 0.12},  // chest
      {.centre_m = {0.13, 0.15, -0.10},
       .radius_m = {0.075, 0.135, 0.15},
       .tilt_deg = {-15, -8},
       .blend_m = 0.04,
       .mirrored = true},  // haunches
      {.centre_m = {0.135, 0.035, 0.06},
       .radius_m = {0.05, 0.035, 0.14},
       .blend_m = 0.05,
       .mirrored = true},  // hind feet
      {.centre_m = {0.06, 0.17, 0.155},
       .radius_m = {0.042, 0.15, 0.048},
       .tilt_deg = {-8, 0},
       .blend_m = 0.05,
       .mirrored = true},  // forelegs
      {.centre_m = {0.062, 0.034, 0.19}, .radius_m = {0.044, 0.034, 0.07}, .blend_m = 0.04, .mirrored = true},   // paws
      {.centre_m = {0.0, 0.16, -0.315}, .radius_m = {0.075, 0.075, 0.07}, .blend_m = 0.03},                      // tail
      {.centre_m = {0.0, 0.555, 0.13}, .radius_m = {0.115, 0.12, 0.145}, .tilt_deg = {15, 0}, .blend_m = 0.09},  // head
      {.centre_m = {0.055, 0.515, 0.20}, .radius_m = {0.065, 0.06, 0.07}, .blend_m = 0.06, .mirrored = true},  // cheeks
      {.centre_m = {0.0, 0.525, 0.255}, .radius_m = {0.045, 0.042, 0.045}, .blend_m = 0.06},                   // muzzle
      {.centre_m = {0.0, 0.55, 0.292}, .radius_m = {0.018, 0.014, 0.014}, .blend_m = 0.018},                   // nose
      {.centre_m = {0.085, 0.59, 0.205},
       .radius_m = {0.026, 0.028, 0.026},
       .blend_m = 0.016,
       .mirrored = true},  // eyes
      {.centre_m = {0.085, 0.80, 0.045},
       .radius_m = {0.054, 0.205, 0.036},
       .tilt_deg = {-12, -10},
       .blend_m = 0.05,
       .mirrored = true},  // ears
      {.centre_m = {0.088, 0.81, 0.073},
       .radius_m = {0.030, 0.15, 0.022},
       .tilt_deg = {-12, -10},
       .blend_m = 0.03,
       .mirrored = true,
       .hollow = true},  // and their shells
  };
}

}  // namespace

Mesh make_rabbit() {
  const BlendedSolid solid(rabbit_parts());
  constexpr double cell_m = 1.0 / 56;
  // An even number of cells across keeps the mirror plane on samples.
  Mesh mesh =
      polygonise(solid, {.min_m = {-14 * cell_m, -2 * cell_m, -24 * cell_m}, .cell_m = cell_m, .count = {28, 61, 43}});
  const Bounds bounds = mesh_bounds(mesh);
  const double height_m = bounds.size_m().y;
  for (glm::dvec3& p : mesh.positions_m) {
    p = {p.x / height_m, (p.y - bounds.min_m.y) / height_m, p.z / height_m};
    mesh.uvs.emplace_back(p.x + 0.5, p.y);
  }
  return mesh;
}

}  // namespace focalstage
