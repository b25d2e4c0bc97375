#include "core/retina/projector_light.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>
#include <glm/gtc/quaternion.hpp>

namespace focalstage {
namespace {

constexpr double nearest_lit_m = 1e-3;    ///< as the compiler's
constexpr double smooth_share = 1e-3;     ///< of the depth: faces that go on within this much cast no edge
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
    : projector_(projector) {
  const Rigid projector_from_world = projector.world_from_projector.inverse();
  turn_ = glm::mat3_cast(projector_from_world.rotation);
  shift_m_ = projector_from_world.position_m;
  raster_ = raster_surfaces(mesh, projector_from_world, grid_over(projector), nearest_lit_m, stop);
  if (!stop.stop_requested()) mark_smooth();
}

void ProjectorLight::mark_smooth() {
  const LookGrid& grid = raster_.grid;
  smooth_.assign(raster_.nearest.size(), 0);
  tbb::parallel_for(1, std::max(1, grid.height_px - 1), [&](int row) {
    for (int column = 1; column + 1 < grid.width_px; ++column) {
      const std::uint32_t own = raster_.at(column, row);
      if (own == SurfaceRaster::nothing) continue;
      const glm::dvec2 look = grid.look(column, row);
      const double inverse_m = raster_.faces[own].inverse_depth(look);
      bool smooth = true;
      for (int i = 0; i < 9 && smooth; ++i) {
        const std::uint32_t face = raster_.at(column + i % 3 - 1, row + i / 3 - 1);
        if (face == own) continue;
        smooth = face != SurfaceRaster::nothing &&
                 std::abs(raster_.faces[face].inverse_depth(look) - inverse_m) <= smooth_share * inverse_m;
      }
      smooth_[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width_px) +
              static_cast<std::size_t>(column)] = smooth ? 1 : 0;
    }
  });
}

/// Away from edges the nearest face of the pixel decides, by its plane. Near one, each face seen in the pixel and its
/// neighbours is asked whether it stands before the very spot.
bool ProjectorLight::shadowed(const glm::dvec2& tangent, double depth_m, std::uint32_t face) const {
  const LookGrid& grid = raster_.grid;
  const glm::dvec2 place = (tangent - grid.first) / grid.step + 0.5;
  const int column = std::clamp(static_cast<int>(std::floor(place.x)), 0, grid.width_px - 1);
  const int row = std::clamp(static_cast<int>(std::floor(place.y)), 0, grid.height_px - 1);
  const double inverse_m = 1.0 / depth_m;
  const auto at =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width_px) + static_cast<std::size_t>(column);
  if (smooth_[at] != 0) {
    const std::uint32_t nearest = raster_.nearest[at];
    return nearest != face && raster_.faces[nearest].inverse_depth(tangent) > inverse_m * (1.0 + smooth_share);
  }
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

std::optional<glm::dvec2> ProjectorLight::pixel(const glm::dvec3& world_m, std::uint32_t face) const {
  const glm::dvec3 point_m = turn_ * world_m + shift_m_;
  if (!(point_m.z < -nearest_lit_m)) return std::nullopt;
  const glm::dvec2 tangent = glm::dvec2(point_m) / -point_m.z;
  const glm::dvec2 place = (tangent - raster_.grid.first) / raster_.grid.step;
  const glm::dvec2 most(raster_.grid.width_px, raster_.grid.height_px);
  const bool near = place.x > -2.0 && place.y > -2.0 && place.x < most.x + 1.0 && place.y < most.y + 1.0;
  if (!near) return std::nullopt;  // far outside, a strong distortion can fold back into the image
  const glm::dvec2 pixel = pixel_of_tangent(projector_, tangent);
  const bool inside =
      pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < projector_.width_px && pixel.y < projector_.height_px;
  if (!inside || shadowed(tangent, -point_m.z, face)) return std::nullopt;
  return pixel;
}

}  // namespace focalstage
