#include "core/retina/projector_light.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <limits>

namespace focalstage {
namespace {

constexpr double nearest_lit_m = 1e-3;    ///< as the compiler's
constexpr double smooth_share = 5e-4;     ///< of the depth: faces that go on within this much cast no edge
constexpr double hidden_by_share = 1e-4;  ///< what is nearer by less than this is the surface itself

/// The rectangle of the tangent plane that the image covers, distorted as it may be, at the image's resolution.
LookGrid grid_over(const ProjectorModel& projector) {
  constexpr int steps = 32;
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
  for (int i = 0; i <= steps; ++i) {
    const double x = static_cast<double>(projector.width_px) * i / steps;
    const double y = static_cast<double>(projector.height_px) * i / steps;
    for (const glm::dvec2& pixel : {glm::dvec2(x, 0.0), glm::dvec2(x, projector.height_px), glm::dvec2(0.0, y),
                                    glm::dvec2(projector.width_px, y)}) {
      const glm::dvec2 tangent = tangent_of_pixel(projector, pixel);
      low = glm::min(low, tangent);
      high = glm::max(high, tangent);
    }
  }
  LookGrid grid;
  grid.width_px = projector.width_px;
  grid.height_px = projector.height_px;
  const glm::dvec2 size = high - low;
  grid.step = {size.x / grid.width_px, -size.y / grid.height_px};
  grid.first = glm::dvec2(low.x, high.y) + 0.5 * grid.step;
  return grid;
}

}  // namespace

ProjectorLight::ProjectorLight(const SurfaceMesh& mesh, const ProjectorModel& projector, const std::stop_token& stop)
    : projector_(projector), projector_from_world_(projector.world_from_projector.inverse()) {
  raster_ = raster_surfaces(mesh, projector_from_world_, grid_over(projector), nearest_lit_m, stop);
  per_step_ = 1.0 / raster_.grid.step;
  if (stop.stop_requested()) return;
  mark_edges();
  mark_blocks();
}

/// Whether two faces lie at about one depth along both looks: a surface that bends little between them.
bool ProjectorLight::goes_on(std::uint32_t a, std::uint32_t b, const glm::dvec2& one, const glm::dvec2& other) const {
  if (a == b) return true;
  if (b == SurfaceRaster::nothing) return false;
  const auto alike = [&](const glm::dvec2& look) {
    const double inverse_m = raster_.faces[a].inverse_depth(look);
    return std::abs(raster_.faces[b].inverse_depth(look) - inverse_m) <= smooth_share * inverse_m;
  };
  return alike(one) && alike(other);
}

void ProjectorLight::mark_edges() {
  const LookGrid& grid = raster_.grid;
  nearest_inverse_m_.assign(raster_.nearest.size(), -1.0f);
  tbb::parallel_for(1, std::max(1, grid.height_px - 1), [&](int row) {
    for (int column = 1; column + 1 < grid.width_px; ++column) {
      const std::uint32_t own = raster_.at(column, row);
      if (own == SurfaceRaster::nothing) continue;
      const double inverse_m = raster_.faces[own].inverse_depth(grid.look(column, row));
      bool smooth = true;
      for (int i = 0; i < 9 && smooth; ++i) {
        const int x = column + i % 3 - 1, y = row + i / 3 - 1;
        smooth = goes_on(own, raster_.at(x, y), grid.look(column, row), grid.look(x, y));
      }
      nearest_inverse_m_[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width_px) +
                         static_cast<std::size_t>(column)] = static_cast<float>(smooth ? inverse_m : -inverse_m);
    }
  });
}

void ProjectorLight::mark_blocks() {
  const LookGrid& grid = raster_.grid;
  block_columns_ = (grid.width_px + block_px - 1) / block_px;
  const int block_rows = (grid.height_px + block_px - 1) / block_px;
  sole_.assign(static_cast<std::size_t>(block_columns_) * static_cast<std::size_t>(block_rows), SurfaceRaster::nothing);
  tbb::parallel_for(0, block_rows, [&](int row) {
    for (int column = 0; column < block_columns_; ++column) {
      const int left = column * block_px - 1, top = row * block_px - 1;
      if (left < 0 || top < 0 || left + block_px + 1 >= grid.width_px || top + block_px + 1 >= grid.height_px) continue;
      const std::uint32_t face = raster_.at(left, top);
      bool sole = true;
      for (int y = top; sole && y < top + block_px + 2; ++y) {
        for (int x = left; sole && x < left + block_px + 2; ++x) sole = raster_.at(x, y) == face;
      }
      if (sole) {
        sole_[static_cast<std::size_t>(row) * static_cast<std::size_t>(block_columns_) +
              static_cast<std::size_t>(column)] = face;
      }
    }
  });
}

/// Each face seen in the pixel and its neighbours is asked whether it stands before the very spot.
bool ProjectorLight::shadowed_by_one(const glm::dvec2& tangent, int column, int row, double inverse_m,
                                     std::uint32_t face) const {
  const LookGrid& grid = raster_.grid;
  for (int y = std::max(0, row - 1); y <= std::min(grid.height_px - 1, row + 1); ++y) {
    for (int x = std::max(0, column - 1); x <= std::min(grid.width_px - 1, column + 1); ++x) {
      const std::uint32_t before = raster_.at(x, y);
      if (before == SurfaceRaster::nothing || before == face) continue;
      const SeenFace& seen = raster_.faces[before];
      if (seen.inverse_depth(tangent) > inverse_m * (1.0 + hidden_by_share) && seen.covers(tangent)) return true;
    }
  }
  return false;
}

/// Away from edges the depth found at the pixels around says what is lit; all else is looked at closely.
bool ProjectorLight::shadowed(const glm::dvec2& tangent, const glm::dvec2& place, double inverse_m,
                              std::uint32_t face) const {
  const LookGrid& grid = raster_.grid;
  const int column = std::clamp(static_cast<int>(place.x), 0, grid.width_px - 1);
  const int row = std::clamp(static_cast<int>(place.y), 0, grid.height_px - 1);
  const auto block = static_cast<std::size_t>(row / block_px) * static_cast<std::size_t>(block_columns_) +
                     static_cast<std::size_t>(column / block_px);
  if (sole_[block] == face) return false;
  const auto width = static_cast<std::size_t>(grid.width_px);
  const float* own = &nearest_inverse_m_[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)];
  if (*own < 0.0f) return shadowed_by_one(tangent, column, row, inverse_m, face);
  const auto aside_x = static_cast<float>(place.x - column - 0.5), aside_y = static_cast<float>(place.y - row - 0.5);
  const float slope_x = 0.5f * (std::abs(own[1]) - std::abs(own[-1]));
  const float slope_y = 0.5f * (std::abs(own[width]) - std::abs(*(own - width)));
  const double nearest_inverse_m = *own + aside_x * slope_x + aside_y * slope_y;
  const bool lit = nearest_inverse_m <= inverse_m * (1.0 + 2.0 * smooth_share);
  return !lit && shadowed_by_one(tangent, column, row, inverse_m, face);
}

std::optional<glm::dvec2> ProjectorLight::pixel(const glm::dvec3& spot, double scale, std::uint32_t face) const {
  const double per_depth = 1.0 / -spot.z;
  const double inverse_m = per_depth * scale;
  if (!(inverse_m > 0.0 && inverse_m < 1.0 / nearest_lit_m)) return std::nullopt;
  const glm::dvec2 tangent = glm::dvec2(spot) * per_depth;
  const glm::dvec2 place = (tangent - raster_.grid.first) * per_step_ + 0.5;
  // Far outside, a strong distortion can fold back into the image.
  const bool near = place.x > -1.0 && place.y > -1.0 && place.x < raster_.grid.width_px + 1.0 &&
                    place.y < raster_.grid.height_px + 1.0;
  if (!near) return std::nullopt;
  const glm::dvec2 pixel = projector_.distortion.empty() ? place : pixel_of_tangent(projector_, tangent);
  const bool inside =
      pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < projector_.width_px && pixel.y < projector_.height_px;
  if (!inside || shadowed(tangent, place, inverse_m, face)) return std::nullopt;
  return pixel;  // without distortion the grid is the image
}

}  // namespace focalstage
