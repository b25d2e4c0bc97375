#include "core/compile/surface_hits.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/compile/frame.h"

namespace focalstage {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

void take_in(Box& box, float x, float y) {
  box.min_x = std::min(box.min_x, x);
  box.min_y = std::min(box.min_y, y);
  box.max_x = std::max(box.max_x, x);
  box.max_y = std::max(box.max_y, y);
}

TileRays rays_of_tile(const ProjectorModel& projector, int column, int row, double offset_x, double offset_y) {
  TileRays rays;
  for (int i = 0; i < tile_samples; ++i) {
    const int pixel_x = column * tile_side + i % tile_side;
    const int pixel_y = row * tile_side + i / tile_side;
    const bool inside = pixel_x < projector.width_px && pixel_y < projector.height_px;
    const glm::dvec2 tangent = inside ? tangent_of_pixel(projector, {pixel_x + offset_x, pixel_y + offset_y})
                                      : glm::dvec2(std::numeric_limits<double>::quiet_NaN());
    rays.x[i] = tangent.x;
    rays.y[i] = tangent.y;
  }
  return rays;
}

}  // namespace

ProjectorSight::ProjectorSight(const ProjectorModel& projector, const std::vector<ViewDrawable>& surfaces,
                               const Box& bounds, int columns, int rows) {
  set_up(view_, surfaces, projector.world_from_projector.inverse(), nearest_lit_m, bounds);
  sort_into_cells(cells_, view_, bounds, columns, rows, {}, 0.0);
}

void ProjectorSight::meet(const TileRays& rays, const Kernel& kernel, TileMet& met) const {
  std::fill_n(met.drawable, tile_samples, -1);
  met.any = false;
  const LocalLooks local = local_looks(rays.x, rays.y, kernel);
  if (!local.any) return;
  TileNearest nearest;
  kernel.cover(kernel_view(view_, cells_), local.looks, local.origin_x, local.origin_y, nearest);
  for (int i = 0; i < tile_samples; ++i) {
    if (nearest.triangle[i] < 0) continue;
    const ViewTriangle& triangle = view_.triangles[static_cast<std::size_t>(nearest.triangle[i])];
    const double depth_m = 1.0 / triangle.inverse_depth(rays.x[i], rays.y[i]);
    met.any = true;
    met.drawable[i] = static_cast<std::int32_t>(triangle.drawable);
    met.triangle[i] = triangle.triangle;
    met.x[i] = rays.x[i] * depth_m;
    met.y[i] = rays.y[i] * depth_m;
    met.z[i] = -depth_m;
  }
}

Box bounds_of(const ProjectorRays& rays) {
  Box bounds{infinity, infinity, -infinity, -infinity};
  for (const TileRays& tile : rays.tiles) {
    for (int i = 0; i < tile_samples; ++i) {
      if (tile.x[i] == tile.x[i]) take_in(bounds, static_cast<float>(tile.x[i]), static_cast<float>(tile.y[i]));
    }
  }
  return bounds;
}

LocalLooks local_looks(const double* x, const double* y, const Kernel& kernel) {
  LocalLooks local;
  TileHits plain;
  for (int i = 0; i < tile_samples; ++i) {
    if (!local.any && x[i] == x[i]) {
      local.any = true;
      local.origin_x = x[i];
      local.origin_y = y[i];
    }
    plain.surface_m[i] = 1.0f;
  }
  for (int i = 0; i < tile_samples; ++i) {
    plain.x[i] = static_cast<float>(x[i] - local.origin_x);
    plain.y[i] = static_cast<float>(y[i] - local.origin_y);
  }
  kernel.place(plain, local.origin_x, local.origin_y, 0.0f, 0.0f, local.looks);
  return local;
}

double nearest_seen_m(double lens_to_pupil_m) { return lens_to_pupil_m + 1e-3; }

KernelView kernel_view(const ViewTriangles& view, const Cells& cells) {
  return {view.triangles.data(), view.bounds.data(), cells.grid,
          cells.begin.data(),    cells.items.data(), static_cast<float>(view.nearest_m)};
}

ProjectorRays projector_rays(const ProjectorModel& projector, int samples_per_pixel) {
  const int side = static_cast<int>(std::lround(std::sqrt(samples_per_pixel)));
  ProjectorRays rays;
  rays.grid = {projector.width_px, projector.height_px};
  rays.subsamples = side * side;
  const std::size_t per_subsample = rays.grid.count();
  rays.tiles.resize(per_subsample * static_cast<std::size_t>(rays.subsamples));
  tbb::parallel_for(std::size_t{0}, rays.tiles.size(), [&](std::size_t i) {
    const int subsample = static_cast<int>(i / per_subsample);
    const int tile = static_cast<int>(i % per_subsample);
    rays.tiles[i] = rays_of_tile(projector, tile % rays.grid.columns(), tile / rays.grid.columns(),
                                 (subsample % side + 0.5) / side, (subsample / side + 0.5) / side);
  });
  return rays;
}

ProjectorHits projector_hits(const ProjectorRays& rays, const ProjectorSight& sight, const Kernel& kernel) {
  ProjectorHits hits;
  hits.tiles.resize(rays.tiles.size());
  tbb::parallel_for(std::size_t{0}, rays.tiles.size(),
                    [&](std::size_t i) { sight.meet(rays.tiles[i], kernel, hits.tiles[i]); });
  return hits;
}

ProjectorHits projector_hits(const ProjectorRays& rays, const ProjectorModel& projector,
                             const std::vector<ViewDrawable>& surfaces, const Kernel& kernel) {
  const ProjectorSight sight(projector, surfaces, bounds_of(rays), rays.grid.columns(), rays.grid.rows());
  return projector_hits(rays, sight, kernel);
}

}  // namespace focalstage
