#include "editor/tools/drop.h"

#include <algorithm>

namespace focalstage {
namespace {

constexpr std::size_t most_points = 4000;
/// What touches already, or has sunk in by rounding, rests.
constexpr double sunk_in_m = 1e-5;

}  // namespace

std::optional<double> drop_m(const Stage& stage, const std::vector<Drawable>& drawables, const glm::dvec3& way,
                             Picker& picker, const MayPick& may_stop) {
  std::optional<double> nearest_m;
  for (const Drawable& drawable : drawables) {
    const std::vector<glm::dvec3>& points = drawable.mesh->positions_m;
    const std::size_t step = std::max<std::size_t>(1, points.size() / most_points);
    for (std::size_t i = 0; i < points.size(); i += step) {
      const glm::dvec3 from_m(drawable.world_from_mesh * glm::dvec4(points[i], 1.0));
      const std::optional<PickHit> hit = picker.first(stage, {from_m - sunk_in_m * way, way}, may_stop);
      if (!hit) continue;
      const double free_m = std::max(hit->distance_m - sunk_in_m, 0.0);
      if (!nearest_m || free_m < *nearest_m) nearest_m = free_m;
    }
  }
  return nearest_m;
}

}  // namespace focalstage
