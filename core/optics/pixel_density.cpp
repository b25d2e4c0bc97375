#include "core/optics/pixel_density.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace focalstage {
namespace {

/// Pixels per unit of the tangent plane there, by central differences.
double pixels_per_tangent(const ProjectorModel& projector, const glm::dvec2& tangent) {
  if (projector.distortion.empty()) return projector.focal_px.x * projector.focal_px.y;
  constexpr double step = 1e-4;
  const auto change = [&](const glm::dvec2& half) {
    return (place_of_tangent(projector, tangent + half) - place_of_tangent(projector, tangent - half)) / (2.0 * step);
  };
  const glm::dvec2 along_x = change({step, 0.0}), along_y = change({0.0, step});
  return std::abs(along_x.x * along_y.y - along_x.y * along_y.x);
}

}  // namespace

double pixels_per_m2(const ProjectorModel& projector, const glm::dvec3& point_m, const glm::dvec3& normal) {
  if (!(point_m.z < 0.0)) return 0.0;
  const double facing_m = std::abs(glm::dot(normal, point_m));
  const double per_tangent = pixels_per_tangent(projector, glm::dvec2(point_m) / -point_m.z);
  return per_tangent * facing_m / (-point_m.z * point_m.z * point_m.z);
}

double pixels_per_m2_on_axis(const ProjectorModel& projector, double distance_m) {
  return projector.focal_px.x * projector.focal_px.y / (distance_m * distance_m);
}

}  // namespace focalstage
