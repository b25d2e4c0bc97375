#include "core/stage/interpolate.h"

#include <cmath>

#include "core/mesh/circle.h"

namespace focalstage {

glm::dquat slerp(const glm::dquat& a, const glm::dquat& b, double share) {
  if (share == 0.0) return a;
  const glm::dquat near_b = glm::dot(a, b) < 0.0 ? -b : b;
  // From both chords: exact for the smallest angle as for a right one.
  const double angle = 2.0 * angle_of(glm::length(near_b - a), glm::length(near_b + a));
  const double sine = sin_cos(angle).sin;
  if (sine < 1e-12) return glm::normalize(a * (1.0 - share) + near_b * share);
  const double weight_a = sin_cos((1.0 - share) * angle).sin / sine;
  const double weight_b = sin_cos(share * angle).sin / sine;
  return glm::normalize(a * weight_a + near_b * weight_b);
}

}  // namespace focalstage
