#include "core/compile/surface_sights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/compile/kernel.h"
#include "core/compile/surface_hits.h"

namespace focalstage {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Box everything{-infinity, -infinity, infinity, infinity};
constexpr double shadow_tolerance = 1e-3;  ///< of the depth; a shadow's rim may count to either side

/// Whether some pixel's light leaves in this direction. Far off the axis a distortion can fold back into the image: a
/// position counts only if its pixel leads back to it.
bool lights(const ProjectorModel& projector, const glm::dvec2& tangent) {
  const glm::dvec2 pixel = pixel_of_tangent(projector, tangent);
  if (!(pixel.x >= 0.0 && pixel.x <= projector.width_px && pixel.y >= 0.0 && pixel.y <= projector.height_px))
    return false;
  if (projector.distortion.empty()) return true;
  const glm::dvec2 back = tangent_of_pixel(projector, pixel);
  return std::abs(back.x - tangent.x) < 1e-6 && std::abs(back.y - tangent.y) < 1e-6;
}

}  // namespace

Sight::Sight(const std::vector<ViewDrawable>& drawables, const Rigid& view_from_world, double nearest_m,
             int cells_across)
    : bounds_{infinity, infinity, -infinity, -infinity} {
  set_up(view_, drawables, view_from_world, nearest_m, everything);
  for (const ViewTriangles::Run& run : view_.runs) {
    for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
      const Box& box = view_.bounds[i].box;
      bounds_ = {std::min(bounds_.min_x, box.min_x), std::min(bounds_.min_y, box.min_y),
                 std::max(bounds_.max_x, box.max_x), std::max(bounds_.max_y, box.max_y)};
    }
  }
  // What reaches behind the viewer reaches to infinity here; nobody looks that far aside.
  constexpr float widest = 4.0f;
  bounds_ = {std::max(bounds_.min_x, -widest), std::max(bounds_.min_y, -widest), std::min(bounds_.max_x, widest),
             std::min(bounds_.max_y, widest)};
  if (!empty()) sort_into_cells(cells_, view_, bounds_, cells_across, cells_across, {}, 0.0);
}

Sight::Met Sight::nearest(const Looks& looks) const {
  Met met;
  std::fill_n(met.triangle, tile_samples, -1);
  std::fill_n(met.depth_m, tile_samples, nan);
  if (empty()) return met;
  const LocalLooks local = local_looks(looks.x, looks.y, best_kernel());
  if (!local.any) return met;
  TileNearest found;
  best_kernel().cover(kernel_view(view_, cells_), local.looks, local.origin_x, local.origin_y, found);
  for (int i = 0; i < tile_samples; ++i) {
    met.triangle[i] = found.triangle[i];
    if (met.at(i)) met.depth_m[i] = 1.0 / triangle(met, i).inverse_depth(looks.x[i], looks.y[i]);
  }
  return met;
}

SurfaceSights::SurfaceSights(std::vector<ProjectorModel> projectors, double lens_to_pupil_m, int cells_across)
    : projectors_(std::move(projectors)), lens_to_pupil_m_(lens_to_pupil_m), cells_across_(cells_across) {}

void SurfaceSights::look(const Stage& stage, const PerEye<Eye>& eyes) {
  const bool same_surfaces = !from_projectors_.empty() && surfaces_before_ == stage.surfaces;
  const bool same_viewer =
      same_surfaces && viewer_before_ == stage.world_from_viewer && interpupillary_before_m_ == stage.interpupillary_m;
  if (same_viewer) return;
  const std::vector<ViewDrawable> surfaces = drawables_of(stage.surfaces);
  if (!same_surfaces) {
    from_projectors_.clear();
    for (const ProjectorModel& projector : projectors_)
      from_projectors_.emplace_back(surfaces, projector.world_from_projector.inverse(), 1e-3, cells_across_);
  }
  for (const Side side : both_sides) {
    of_surfaces_[side].emplace(surfaces, eyes[side].eye_from_world, nearest_seen_m(lens_to_pupil_m_), cells_across_);
  }
  surfaces_before_ = stage.surfaces;
  viewer_before_ = stage.world_from_viewer;
  interpupillary_before_m_ = stage.interpupillary_m;
}

std::array<bool, tile_samples> SurfaceSights::reached(const Rigid& eye_from_world, const Sight::Looks& looks,
                                                      const Sight::Met& met) const {
  std::array<bool, tile_samples> lit{};
  for (std::size_t i = 0; i < projectors_.size(); ++i) add_reached(i, eye_from_world, looks, met, lit);
  return lit;
}

void SurfaceSights::add_reached(std::size_t projector, const Rigid& eye_from_world, const Sight::Looks& looks,
                                const Sight::Met& met, std::array<bool, tile_samples>& lit) const {
  const ProjectorModel& model = projectors_[projector];
  const Rigid projector_from_eye = model.world_from_projector.inverse() * eye_from_world.inverse();
  Sight::Looks towards;
  double depth_m[tile_samples];
  for (int i = 0; i < tile_samples; ++i) {
    towards.x[i] = towards.y[i] = nan;
    if (!met.at(i)) continue;
    const glm::dvec3 point = projector_from_eye.point(glm::dvec3(looks.x[i], looks.y[i], -1.0) * met.depth_m[i]);
    depth_m[i] = -point.z;
    if (!(depth_m[i] > 0.0)) continue;
    const glm::dvec2 tangent{point.x / depth_m[i], point.y / depth_m[i]};
    if (!lights(model, tangent)) continue;
    towards.x[i] = tangent.x;
    towards.y[i] = tangent.y;
  }
  const Sight::Met first = from_projectors_[projector].nearest(towards);
  for (int i = 0; i < tile_samples; ++i) {
    if (std::isnan(towards.x[i])) continue;
    if (!first.at(i) || first.depth_m[i] >= depth_m[i] * (1.0 - shadow_tolerance))
      lit[static_cast<std::size_t>(i)] = true;
  }
}

}  // namespace focalstage
