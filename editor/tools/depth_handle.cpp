#include "editor/tools/depth_handle.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/optics/vergence.h"
#include "editor/tools/known_bounds.h"
#include "editor/tools/nearest_on_line.h"

namespace focalstage {
namespace {

constexpr double nearest_d = 20.0;
constexpr double farthest_d = 0.05;

std::optional<double> wanted_d(const Project& project, const Depth& depth, double placed_d,
                               const std::optional<double>& surface_m) {
  switch (depth.mode) {
    case DepthMode::placed:
      return placed_d;
    case DepthMode::fixed:
      return depth.vergence_d;
    case DepthMode::offset:
      return placed_d + depth.vergence_d;
    case DepthMode::slice: {
      const auto index = static_cast<std::size_t>(std::max(depth.index, 0));
      if (!surface_m || depth.index < 0 || index >= project.slices.powers_d.size()) return std::nullopt;
      return image_vergence_d(*surface_m, project.slices.powers_d[index]);
    }
  }
  return std::nullopt;
}

/// Along a look, axial distances grow slower than lengths.
double axial_share(const glm::dvec2& look) { return 1.0 / std::sqrt(1.0 + glm::dot(look, look)); }

}  // namespace

std::optional<DepthReading> read_depth(const Project& project, const Stage& stage, const StagedObject& object,
                                       Picker& picker) {
  const Bounds bounds = rough_world_bounds(object.drawables);
  if (bounds.empty()) return std::nullopt;
  const SightFrame sight = sight_frame(project, stage);
  const double centre_m = sight.axial_m(0.5 * (bounds.min_m + bounds.max_m));
  if (centre_m <= 1e-3) return std::nullopt;
  DepthReading reading;
  reading.vergence_d = 1.0 / centre_m;
  reading.surface_m = surface_behind_m(sight, stage, object.drawables, picker);
  const std::optional<double> wanted = wanted_d(project, object.depth, reading.vergence_d, reading.surface_m);
  if (!wanted) return std::nullopt;
  reading.accommodation_d = *wanted;
  reading.conflict_d = reading.accommodation_d - reading.vergence_d;
  return reading;
}

std::optional<DepthSheet> depth_sheet(const SightFrame& sight, const StagedObject& object, double accommodation_d,
                                      double farthest_m) {
  const LookBox box = looks_at(sight, object.drawables);
  if (box.empty() || !(accommodation_d >= 1.0 / farthest_m)) return std::nullopt;
  const double axial_m = 1.0 / accommodation_d;
  const glm::dvec2 margin = 0.08 * (box.high - box.low);
  const glm::dvec2 low = box.low - margin;
  const glm::dvec2 high = box.high + margin;
  return DepthSheet{{sight.point_at(low, axial_m), sight.point_at({high.x, low.y}, axial_m),
                     sight.point_at(high, axial_m), sight.point_at({low.x, high.y}, axial_m)},
                    sight.point_at(box.middle(), axial_m),
                    box.middle()};
}

DepthDrag start_depth_drag(const StagedObject& object, const SightFrame& sight, const DepthSheet& sheet,
                           double accommodation_d, const RoomView& view, const glm::dvec2& pixel) {
  DepthDrag drag{object.name, sight, view, sheet.look, 0.0, accommodation_d};
  const double sheet_m = glm::length(sheet.centre_m - sight.world_from_viewer.position_m);
  const auto under_m = nearest_on_line_m(sight.ray_along(sheet.look), ray_through(view, pixel));
  drag.offset_m = under_m ? sheet_m - *under_m : 0.0;
  return drag;
}

double vergence_dragged_d(const DepthDrag& drag, const glm::dvec2& pixel, double snap_d) {
  const auto under_m = nearest_on_line_m(drag.sight.ray_along(drag.look), ray_through(drag.view, pixel));
  if (!under_m) return drag.start_d;
  const double axial_m = (*under_m + drag.offset_m) * axial_share(drag.look) - drag.sight.lens_to_pupil_m;
  double vergence_d = std::clamp(1.0 / std::max(axial_m, 1e-6), farthest_d, nearest_d);
  if (snap_d > 0.0) vergence_d = std::max(snap_d, std::round(vergence_d / snap_d) * snap_d);
  return vergence_d;
}

Edit depth_edit(const std::string& object, double vergence_d) {
  Value depth;
  depth.set("mode", "fixed");
  depth.set("vergence_d", std::round(vergence_d * 1000.0) / 1000.0);
  return {Edit::Kind::set, "objects", object, "depth", depth};
}

}  // namespace focalstage
