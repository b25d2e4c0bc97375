#include "core/optics/look.h"

#include <glm/geometric.hpp>

namespace focalstage {

glm::dvec2 straight_look(const glm::dvec3& eye_point_m) {
  return glm::dvec2(eye_point_m.x, eye_point_m.y) / -eye_point_m.z;
}

double look_stretch(double power_d, double surface_m, double lens_to_pupil_m) {
  const double from_pupil_m = surface_m + lens_to_pupil_m;
  return from_pupil_m / (from_pupil_m - power_d * lens_to_pupil_m * surface_m);
}

double plane_distance_m(const glm::dvec2& look, const glm::dvec3& eye_point_m, const glm::dvec3& eye_normal,
                        double lens_to_pupil_m) {
  const double own_m = -eye_point_m.z - lens_to_pupil_m;
  const double along = glm::dot(eye_normal, glm::dvec3(look, -1.0));
  const double met_m = glm::dot(eye_normal, eye_point_m) / along - lens_to_pupil_m;
  return along != 0.0 && met_m > 0.0 ? met_m : own_m;
}

}  // namespace focalstage
