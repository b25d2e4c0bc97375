#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "core/compile/surface_hits.h"
#include "core/mesh/smooth_parts.h"

namespace focalstage {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double hidden_tolerance = 1e-4;  ///< of the depth: what is nearer by less than this is the surface itself

/// What an eye must know of one surface drawable.
struct SurfaceFacts {
  /// How 1/depth changes over the plane of each triangle, per unit of look; zero for a plane through the pupil, on
  /// which every look keeps the point's own distance.
  std::vector<glm::dvec2> plane_slope;
  /// Planar breathing only: the axial distance of each triangle's smooth part from the lens centre.
  std::vector<float> part_m;
};

glm::dvec2 plane_slope(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double offset = glm::dot(normal, a);
  const glm::dvec2 slope = glm::dvec2(normal.x, normal.y) / offset;
  return std::isfinite(slope.x) && std::isfinite(slope.y) ? slope : glm::dvec2(0.0);
}

SurfaceFacts facts_of(const Drawable& drawable, const Eye& eye, Breathing breathing) {
  const Mesh& mesh = *drawable.mesh;
  const glm::dmat4 eye_from_mesh = eye.eye_from_world.matrix() * drawable.world_from_mesh;
  const auto point = [&](std::uint32_t i) { return glm::dvec3(eye_from_mesh * glm::dvec4(mesh.positions_m[i], 1.0)); };
  SurfaceFacts facts;
  facts.plane_slope.resize(mesh.triangles.size());
  tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t i) {
    const glm::uvec3& t = mesh.triangles[i];
    facts.plane_slope[i] = plane_slope(point(t.x), point(t.y), point(t.z));
  });
  if (breathing != Breathing::planar) return facts;
  const SmoothParts parts = placed(smooth_parts(mesh), mesh, eye_from_mesh);
  for (const std::uint32_t part : parts.part_of_triangle) {
    facts.part_m.push_back(static_cast<float>(-parts.centre_m[part].z - eye.lens_to_pupil_m));
  }
  return facts;
}

/// The hits of one tile before occlusion, with their looks in double.
struct SeenTile {
  double x[tile_samples];
  double y[tile_samples];
  double depth_m[tile_samples];
};

bool see(const TileMet& met, const Rigid& eye_from_projector, double nearest_m, SeenTile& seen) {
  bool any = false;
  for (int i = 0; i < tile_samples; ++i) {
    seen.x[i] = seen.y[i] = std::numeric_limits<double>::quiet_NaN();
    if (met.drawable[i] < 0) continue;
    const glm::dvec3 point = eye_from_projector.point({met.x[i], met.y[i], met.z[i]});
    if (-point.z <= nearest_m) continue;
    seen.depth_m[i] = -point.z;
    seen.x[i] = point.x / -point.z;
    seen.y[i] = point.y / -point.z;
    any = true;
  }
  return any;
}

/// Drops what another surface hides: some surface along the straight look is nearer than the point itself.
void hide(SeenTile& seen, const EyeTile& tile, const KernelView& view, const Kernel& kernel) {
  TileLooks looks;
  kernel.place(tile.hits, tile.origin_x, tile.origin_y, 0.0f, 1.0f, looks);
  TileNearest nearest;
  kernel.cover(view, looks, tile.origin_x, tile.origin_y, nearest);
  for (int i = 0; i < tile_samples; ++i) {
    const double found = nearest.inverse_m[i];
    if (nearest.triangle[i] >= 0 && found * seen.depth_m[i] * (1.0 - hidden_tolerance) > 1.0) {
      seen.x[i] = seen.y[i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

void set_origin(const SeenTile& seen, EyeTile& tile) {
  for (int i = 0; i < tile_samples; ++i) {
    if (seen.x[i] != seen.x[i]) continue;
    tile.origin_x = seen.x[i];
    tile.origin_y = seen.y[i];
    return;
  }
}

void set_looks(const SeenTile& seen, EyeTile& tile) {
  for (int i = 0; i < tile_samples; ++i) {
    tile.hits.x[i] = static_cast<float>(seen.x[i] - tile.origin_x);
    tile.hits.y[i] = static_cast<float>(seen.y[i] - tile.origin_y);
    tile.hits.surface_m[i] = 1.0f;
    tile.hits.inverse_m[i] = 1.0f;
    tile.hits.slope[i] = 0.0f;
  }
}

void set_distances(const SeenTile& seen, const TileMet& met, const std::vector<SurfaceFacts>& facts,
                   double lens_to_pupil_m, Breathing breathing, EyeTile& tile) {
  tile.any = false;
  tile.straight = {infinity, infinity, -infinity, -infinity};
  tile.min_surface_m = tile.min_inverse_m = infinity;
  tile.max_surface_m = tile.max_inverse_m = -infinity;
  tile.max_slope = 0.0f;
  for (int i = 0; i < tile_samples; ++i) {
    if (seen.x[i] != seen.x[i]) continue;
    const SurfaceFacts& of_surface = facts[static_cast<std::size_t>(met.drawable[i])];
    const glm::dvec2& slope = of_surface.plane_slope[met.triangle[i]];
    const float surface_m = breathing == Breathing::planar ? of_surface.part_m[met.triangle[i]]
                                                           : static_cast<float>(seen.depth_m[i] - lens_to_pupil_m);
    TileHits& hits = tile.hits;
    hits.surface_m[i] = surface_m;
    hits.inverse_m[i] = static_cast<float>(1.0 / seen.depth_m[i]);
    hits.slope[i] = static_cast<float>(slope.x * seen.x[i] + slope.y * seen.y[i]);
    tile.any = true;
    const auto x = static_cast<float>(seen.x[i]);
    const auto y = static_cast<float>(seen.y[i]);
    tile.straight = {std::min(tile.straight.min_x, x), std::min(tile.straight.min_y, y),
                     std::max(tile.straight.max_x, x), std::max(tile.straight.max_y, y)};
    tile.min_surface_m = std::min(tile.min_surface_m, surface_m);
    tile.max_surface_m = std::max(tile.max_surface_m, surface_m);
    tile.min_inverse_m = std::min(tile.min_inverse_m, hits.inverse_m[i]);
    tile.max_inverse_m = std::max(tile.max_inverse_m, hits.inverse_m[i]);
    tile.max_slope = std::max(tile.max_slope, std::abs(hits.slope[i]));
  }
}

}  // namespace

EyeHits eye_hits(const ProjectorHits& met, const TileGrid& grid, const Rigid& world_from_projector, const Eye& eye,
                 const std::vector<ViewDrawable>& surfaces, Breathing breathing, const Kernel& kernel) {
  const double nearest_m = nearest_seen_m(eye.lens_to_pupil_m);
  std::vector<SurfaceFacts> facts;
  for (const ViewDrawable& surface : surfaces) facts.push_back(facts_of(*surface.drawable, eye, breathing));

  const Rigid eye_from_projector = eye.eye_from_world * world_from_projector;
  EyeHits out;
  out.tiles.resize(met.tiles.size());
  std::vector<SeenTile> seen(met.tiles.size());
  tbb::parallel_for(std::size_t{0}, met.tiles.size(), [&](std::size_t i) {
    out.tiles[i].any = met.tiles[i].any && see(met.tiles[i], eye_from_projector, nearest_m, seen[i]);
    if (!out.tiles[i].any) return;
    set_origin(seen[i], out.tiles[i]);
    set_looks(seen[i], out.tiles[i]);
    set_distances(seen[i], met.tiles[i], facts, eye.lens_to_pupil_m, breathing, out.tiles[i]);
  });

  Box bounds{infinity, infinity, -infinity, -infinity};
  for (const EyeTile& tile : out.tiles) {
    if (!tile.any) continue;
    bounds = {std::min(bounds.min_x, tile.straight.min_x), std::min(bounds.min_y, tile.straight.min_y),
              std::max(bounds.max_x, tile.straight.max_x), std::max(bounds.max_y, tile.straight.max_y)};
  }
  if (!(bounds.min_x <= bounds.max_x)) return out;
  ViewTriangles view;
  set_up(view, surfaces, eye.eye_from_world, nearest_m, bounds);
  Cells cells;
  sort_into_cells(cells, view, bounds, grid.columns(), grid.rows(), {}, 0.0);
  const KernelView in_cells = kernel_view(view, cells);
  tbb::parallel_for(std::size_t{0}, met.tiles.size(), [&](std::size_t i) {
    EyeTile& tile = out.tiles[i];
    if (!tile.any) return;
    hide(seen[i], tile, in_cells, kernel);
    set_looks(seen[i], tile);
    set_distances(seen[i], met.tiles[i], facts, eye.lens_to_pupil_m, breathing, tile);
  });
  return out;
}

}  // namespace focalstage
