#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace focalstage {

/// A rotation and then a translation. Named by both ends, target first: `eye_from_world`.
struct Rigid {
  glm::dvec3 position_m{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< unit; glm's constructor order is w, x, y, z

  bool operator==(const Rigid&) const = default;

  glm::dvec3 point(const glm::dvec3& p) const { return rotation * p + position_m; }
  glm::dvec3 direction(const glm::dvec3& d) const { return rotation * d; }

  Rigid inverse() const {
    const glm::dquat back = glm::conjugate(rotation);
    return {back * -position_m, back};
  }

  glm::dmat4 matrix() const {
    glm::dmat4 m = glm::mat4_cast(rotation);
    m[3] = glm::dvec4(position_m, 1.0);
    return m;
  }
};

/// a_from_b * b_from_c = a_from_c.
inline Rigid operator*(const Rigid& a_from_b, const Rigid& b_from_c) {
  return {a_from_b.point(b_from_c.position_m), a_from_b.rotation * b_from_c.rotation};
}

}  // namespace focalstage
