#include "core/retina/slice_map.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace focalstage {
namespace {

constexpr double near_plane_m = 1e-3;  ///< nothing nearer to the lens centre is seen, as in the compiler

/// Area of the projector's image between neighbouring looks, summed; only where they see one face.
struct Footprint {
  double area_px = 0.0;
  int count = 0;
};

/// Reads the nearest faces of one slice into spots.
class Spotter {
 public:
  Spotter(const SurfaceRaster& raster, const ProjectorLight& light, const SliceEye& eye, double lens_radius_m)
      : raster_(raster), light_(light), eye_(eye) {
    const Rigid projector_from_slice = light.projector_from_world() * eye.slice_from_world.inverse();
    turn_ = glm::mat3_cast(projector_from_slice.rotation);
    shift_m_ = projector_from_slice.position_m;
    const double most_look = lens_radius_m / eye.lens_to_pupil_m;  // infinite where lens and pupil are one
    most_look_squared_ = most_look * most_look;
  }

  void row(const LookGrid& grid, int row, SliceSpot* spots) const {
    for (int column = 0; column < grid.width_px; ++column) {
      const std::uint32_t face = raster_.at(column, row);
      if (face == SurfaceRaster::nothing) continue;
      const glm::dvec2 look = grid.look(column, row);
      if (glm::dot(look, look) > most_look_squared_) continue;
      spots[column] = spot(look * eye_.narrowing, face);
    }
  }

 private:
  /// The picture's vergence at the pupil, 1 / (1 / (1/d_p - v) + d_e), and the spot as the projector sees it; both in
  /// one division each, from the inverse of the distance.
  SliceSpot spot(const glm::dvec2& narrowed, std::uint32_t face) const {
    const double inverse_m = raster_.faces[face].inverse_depth(narrowed);
    const double beyond_lens = 1.0 - eye_.behind_lens_m * inverse_m;  // d_p * inverse_m
    const double vergence = inverse_m - eye_.power_d * beyond_lens;   // (1/d_p - v) * beyond_lens
    const double grown = beyond_lens + eye_.lens_to_pupil_m * vergence;
    SliceSpot spot;
    spot.vergence_d = static_cast<float>(grown > 0.0 ? vergence / grown : -most_vergence_d);
    if (const auto pixel = light_.pixel(turn_ * glm::dvec3(narrowed, -1.0) + shift_m_ * inverse_m, inverse_m, face)) {
      spot.x_px = static_cast<float>(pixel->x);
      spot.y_px = static_cast<float>(pixel->y);
    }
    return spot;
  }

  const SurfaceRaster& raster_;
  const ProjectorLight& light_;
  const SliceEye& eye_;
  double most_look_squared_ = 0.0;
  glm::dmat3 turn_;
  glm::dvec3 shift_m_;
};

/// Of every fourth look along a row.
Footprint footprint_of_row(const SurfaceRaster& raster, const std::vector<SliceSpot>& spots, int row) {
  Footprint sum;
  const auto width = static_cast<std::size_t>(raster.grid.width_px);
  const SliceSpot* own = &spots[static_cast<std::size_t>(row) * width];
  for (int column = 0; column + 1 < raster.grid.width_px; column += 4) {
    const SliceSpot &a = own[column], &b = own[column + 1], &c = own[static_cast<std::size_t>(column) + width];
    if (!a.lit() || !b.lit() || !c.lit()) continue;
    const std::uint32_t face = raster.at(column, row);
    if (raster.at(column + 1, row) != face || raster.at(column, row + 1) != face) continue;
    sum.area_px += std::abs((b.x_px - a.x_px) * (c.y_px - a.y_px) - (b.y_px - a.y_px) * (c.x_px - a.x_px));
    ++sum.count;
  }
  return sum;
}

void measure(const SurfaceRaster& raster, SliceMap& map) {
  for (const SliceSpot& spot : map.spots) {
    if (!spot.lit()) continue;
    map.lowest_vergence_d = map.any ? std::min(map.lowest_vergence_d, spot.vergence_d) : spot.vergence_d;
    map.highest_vergence_d = map.any ? std::max(map.highest_vergence_d, spot.vergence_d) : spot.vergence_d;
    map.any = true;
  }
  Footprint sum;
  for (int row = 0; row + 1 < map.grid.height_px; row += 4) {
    const Footprint one = footprint_of_row(raster, map.spots, row);
    sum.area_px += one.area_px;
    sum.count += one.count;
  }
  if (sum.count > 0) map.footprint_px = std::sqrt(sum.area_px / sum.count);
}

}  // namespace

SliceMap slice_map(const SurfaceMesh& mesh, const ProjectorLight& light, const SliceEye& eye, double lens_radius_m,
                   const LookGrid& grid, const std::stop_token& stop) {
  SliceMap map;
  map.grid = grid;
  map.power_d = eye.power_d;
  map.spots.resize(static_cast<std::size_t>(grid.width_px) * static_cast<std::size_t>(grid.height_px));
  if (!eye.sees()) return map;
  LookGrid narrowed = grid;
  narrowed.first *= eye.narrowing;
  narrowed.step *= eye.narrowing;
  const SurfaceRaster raster =
      raster_surfaces(mesh, eye.slice_from_world, narrowed, eye.behind_lens_m + near_plane_m, stop);
  const Spotter spotter(raster, light, eye, lens_radius_m);
  tbb::parallel_for(0, grid.height_px, [&](int row) {
    if (stop.stop_requested()) return;
    spotter.row(grid, row, &map.spots[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width_px)]);
  });
  if (!stop.stop_requested()) measure(raster, map);
  return map;
}

}  // namespace focalstage
