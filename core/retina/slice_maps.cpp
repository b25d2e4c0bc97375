#include "core/retina/slice_maps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/optics/eye.h"

namespace focalstage {

namespace {

/// A ray to the pupil's rim passes the lens so much further from its centre than the look does, at most, rounded up so
/// that the maps need not be made anew for each pupil.
double widest_off_axis_m(const RetinaInput& input, const RetinaView& view) {
  constexpr double step_m = 0.002;
  return input.lens_aperture_m / 2.0 + std::ceil(view.pupil_m / 2.0 / step_m) * step_m;
}

}  // namespace

Eye eye_of(const RetinaInput& input, const RetinaView& view) {
  const Stage& stage = *input.stage;
  const Rigid viewer_from_moved{view.head_offset_m, {1.0, 0.0, 0.0, 0.0}};
  return eyes_of(stage.world_from_viewer * viewer_from_moved, stage.interpupillary_m, input.lens_to_pupil_m)[view.eye];
}

glm::dvec2 look_of_pixel(const RetinaView& view, const glm::dvec2& pixel) {
  const double per_px = 2.0 * std::tan(view.fov_deg * std::numbers::pi / 360.0) / view.width_px;
  return view.gaze + per_px * glm::dvec2(pixel.x - view.width_px / 2.0, view.height_px / 2.0 - pixel.y);
}

glm::dvec2 pixel_of_look(const RetinaView& view, const glm::dvec2& look) {
  const double per_px = 2.0 * std::tan(view.fov_deg * std::numbers::pi / 360.0) / view.width_px;
  const glm::dvec2 aside = (look - view.gaze) / per_px;
  return {view.width_px / 2.0 + aside.x, view.height_px / 2.0 - aside.y};
}

LookGrid grid_of(const RetinaView& view, int margin_px) {
  LookGrid grid;
  grid.width_px = view.width_px + 2 * margin_px;
  grid.height_px = view.height_px + 2 * margin_px;
  grid.first = look_of_pixel(view, glm::dvec2(0.5 - margin_px));
  grid.step = look_of_pixel(view, glm::dvec2(1.5 - margin_px)) - grid.first;
  return grid;
}

/// Whether nothing stood still.
bool SliceMaps::stand(const RetinaInput& input, const std::stop_token& stop) {
  std::vector<Standing> now;
  for (const StagedSurface& surface : input.stage->surfaces) {
    for (const Drawable& drawable : surface.drawables) {
      now.push_back({drawable.mesh, drawable.world_from_mesh, drawable.finish});
    }
  }
  const bool same = light_ && now == standing_;
  if (same && projector_ == input.projector && falloff_reference_m_ == input.falloff_reference_m) return false;
  maps_.clear();
  light_.reset();
  if (!same) mesh_ = surface_mesh(input.stage->surfaces);
  standing_ = std::move(now);
  projector_ = input.projector;
  falloff_reference_m_ = input.falloff_reference_m;
  paint_ = std::make_unique<const SurfacePaint>(input, mesh_);
  if (paint_->plain()) paint_.reset();
  ProjectorLight light(mesh_, projector_, stop);
  if (!stop.stop_requested()) light_ = std::move(light);
  return true;
}

const SliceMap* SliceMaps::kept(double power_d) const {
  for (const auto& map : maps_) {
    if (map->power_d == power_d) return map.get();
  }
  return nullptr;
}

std::vector<const SliceMap*> SliceMaps::of(const RetinaInput& input, const RetinaView& view, int margin_px,
                                           const std::vector<double>& powers_d, const std::stop_token& stop) {
  stand(input, stop);
  const Eye eye = eye_of(input, view);
  const LookGrid grid = grid_of(view, margin_px);
  const Viewpoint viewpoint{eye.eye_from_world,
                            input.lens_to_pupil_m,
                            widest_off_axis_m(input, view),
                            input.projector_focus,
                            grid.first,
                            grid.step,
                            grid.width_px,
                            grid.height_px};
  if (viewpoint_ != viewpoint) maps_.clear();
  viewpoint_ = viewpoint;
  std::erase_if(maps_, [&](const auto& map) {
    return std::find(powers_d.begin(), powers_d.end(), map->power_d) == powers_d.end();
  });
  std::vector<const SliceMap*> all;
  for (const double power_d : powers_d) {
    if (stop.stop_requested()) return {};
    if (const SliceMap* map = kept(power_d)) {
      all.push_back(map);
      continue;
    }
    const SliceScene scene{mesh_,    *light_, paint_.get(), viewpoint.projector_focus, viewpoint.widest_off_axis_m,
                           margin_px};
    auto made = std::make_unique<SliceMap>(slice_map(scene, slice_eye(eye, power_d), grid, stop));
    if (stop.stop_requested()) return {};
    maps_.push_back(std::move(made));
    all.push_back(maps_.back().get());
  }
  return all;
}

}  // namespace focalstage
