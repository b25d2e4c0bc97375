#include "core/retina/surface_raster.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace focalstage {
namespace {

constexpr int bands = 8;

struct RowRange {
  int begin = 0;
  int end = 0;
};

SeenFace seen_face(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 normals[3] = {glm::cross(b, c), glm::cross(c, a), glm::cross(a, b)};
  const double volume = glm::dot(a, normals[0]);
  SeenFace face;
  if (volume == 0.0 || !std::isfinite(volume)) return face;
  const double side = volume < 0.0 ? -1.0 : 1.0;
  for (int i = 0; i < 3; ++i) face.edge[i] = side * glm::dvec3(normals[i].x, normals[i].y, -normals[i].z);
  face.inverse_m = (face.edge[0] + face.edge[1] + face.edge[2]) / std::abs(volume);
  return face;
}

PixelBox box_of(const glm::dvec3* corners_m[3], const LookGrid& grid) {
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3& corner_m = *corners_m[i];
    if (!(corner_m.z < -1e-6)) return {0, grid.width_px, 0, grid.height_px};
    const glm::dvec2 place = (glm::dvec2(corner_m) / -corner_m.z - grid.first) / grid.step;
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
  const glm::dvec2 size(grid.width_px, grid.height_px);
  low = glm::clamp(glm::floor(low) - 1.0, glm::dvec2(0.0), size);
  high = glm::clamp(glm::ceil(high) + 2.0, glm::dvec2(0.0), size);
  return {static_cast<int>(low.x), static_cast<int>(high.x), static_cast<int>(low.y), static_cast<int>(high.y)};
}

/// The columns of a row that lie inside all edges. Both faces of an edge find the same crossing and both take it, with
/// a billionth of a pixel for the corners, where the crossings of several edges differ by their rounding: what two
/// faces cover, the nearer gets.
RowRange columns_of(const SeenFace& face, const LookGrid& grid, double look_y) {
  constexpr double slack = 1e-9;
  double begin = 0.0, end = grid.width_px;
  for (const glm::dvec3& edge : face.edge) {
    const double slope = edge.x * grid.step.x;
    const double start = edge.x * grid.first.x + edge.y * look_y + edge.z;
    if (slope == 0.0) {
      if (start < 0.0) return {};
      continue;
    }
    const double crossing = -start / slope;
    if (slope > 0.0) {
      begin = std::max(begin, std::ceil(crossing - slack));
    } else {
      end = std::min(end, std::floor(crossing + slack) + 1.0);
    }
  }
  if (!(begin < end)) return {};
  return {static_cast<int>(begin), static_cast<int>(end)};
}

struct Band {
  RowRange rows;
  std::vector<double> inverse_m;  ///< of the nearest so far; 0: nothing
};

void draw(std::uint32_t index, const SeenFace& face, RowRange rows, double most_inverse_m, Band& band,
          SurfaceRaster& raster) {
  const LookGrid& grid = raster.grid;
  const auto width = static_cast<std::size_t>(grid.width_px);
  for (int row = rows.begin; row < rows.end; ++row) {
    const double look_y = grid.first.y + row * grid.step.y;
    const RowRange columns = columns_of(face, grid, look_y);
    const double start = face.inverse_depth({grid.first.x, look_y});
    const double slope = face.inverse_m.x * grid.step.x;
    double* nearest_m = &band.inverse_m[static_cast<std::size_t>(row - band.rows.begin) * width];
    std::uint32_t* nearest = &raster.nearest[static_cast<std::size_t>(row) * width];
    for (int column = columns.begin; column < columns.end; ++column) {
      const double inverse_m = start + slope * column;
      if (!(inverse_m > nearest_m[column]) || inverse_m > most_inverse_m) continue;
      nearest_m[column] = inverse_m;
      nearest[column] = index;
    }
  }
}

}  // namespace

void append(SurfaceMesh& all, const Drawable& drawable) {
  const auto first = static_cast<std::uint32_t>(all.points_m.size());
  for (const glm::dvec3& position_m : drawable.mesh->positions_m) {
    all.points_m.emplace_back(drawable.world_from_mesh * glm::dvec4(position_m, 1.0));
  }
  for (const glm::uvec3& triangle : drawable.mesh->triangles) all.faces.push_back(triangle + first);
}

SurfaceMesh surface_mesh(const std::vector<StagedSurface>& surfaces) {
  SurfaceMesh all;
  for (const StagedSurface& surface : surfaces) {
    for (const Drawable& drawable : surface.drawables) append(all, drawable);
  }
  return all;
}

SurfaceRaster raster_surfaces(const SurfaceMesh& mesh, const Rigid& view_from_world, const LookGrid& grid,
                              double nearest_m, const std::stop_token& stop) {
  SurfaceRaster raster;
  raster.grid = grid;
  raster.faces.resize(mesh.faces.size());
  raster.nearest.assign(static_cast<std::size_t>(grid.width_px) * static_cast<std::size_t>(grid.height_px),
                        SurfaceRaster::nothing);
  std::vector<glm::dvec3> points_m(mesh.points_m.size());
  const glm::dmat3 turn = glm::mat3_cast(view_from_world.rotation);
  tbb::parallel_for(std::size_t{0}, points_m.size(),
                    [&](std::size_t i) { points_m[i] = turn * mesh.points_m[i] + view_from_world.position_m; });
  raster.boxes.resize(mesh.faces.size());
  tbb::parallel_for(std::size_t{0}, mesh.faces.size(), [&](std::size_t i) {
    const glm::uvec3& face = mesh.faces[i];
    const glm::dvec3* corners_m[3] = {&points_m[face.x], &points_m[face.y], &points_m[face.z]};
    raster.faces[i] = seen_face(*corners_m[0], *corners_m[1], *corners_m[2]);
    if (raster.faces[i].inverse_m != glm::dvec3(0.0)) raster.boxes[i] = box_of(corners_m, grid);
  });
  tbb::parallel_for(0, bands, [&](int i) {
    Band band;
    band.rows = {grid.height_px * i / bands, grid.height_px * (i + 1) / bands};
    band.inverse_m.assign(
        static_cast<std::size_t>(band.rows.end - band.rows.begin) * static_cast<std::size_t>(grid.width_px), 0.0);
    for (std::size_t face = 0; face < raster.boxes.size(); ++face) {
      if (face % 1024 == 0 && stop.stop_requested()) return;
      const PixelBox& box = raster.boxes[face];
      const RowRange own{std::max(box.row_begin, band.rows.begin), std::min(box.row_end, band.rows.end)};
      if (own.begin < own.end && !box.empty()) {
        draw(static_cast<std::uint32_t>(face), raster.faces[face], own, 1.0 / nearest_m, band, raster);
      }
    }
  });
  return raster;
}

}  // namespace focalstage
