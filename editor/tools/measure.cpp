#include "editor/tools/measure.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace focalstage {

MeasuredGap measured(const SightFrame& sight, const glm::dvec3& a_m, const glm::dvec3& b_m) {
  MeasuredGap between;
  between.distance_m = glm::length(b_m - a_m);
  const double axial_a_m = sight.axial_m(a_m);
  const double axial_b_m = sight.axial_m(b_m);
  if (axial_a_m > 0.0 && axial_b_m > 0.0) between.difference_d = 1.0 / axial_a_m - 1.0 / axial_b_m;
  const glm::dvec3 to_a = a_m - sight.world_from_viewer.position_m;
  const glm::dvec3 to_b = b_m - sight.world_from_viewer.position_m;
  // By both sine and cosine: exact for small angles, where the arc cosine is not.
  between.angle_deg = glm::degrees(std::atan2(glm::length(glm::cross(to_a, to_b)), glm::dot(to_a, to_b)));
  return between;
}

}  // namespace focalstage
