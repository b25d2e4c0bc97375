#include "editor/session/angles.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace focalstage {
namespace {

constexpr glm::dvec3 right(1.0, 0.0, 0.0);
constexpr glm::dvec3 up(0.0, 1.0, 0.0);
constexpr glm::dvec3 back(0.0, 0.0, 1.0);
/// Of the pitch's cosine: below it yaw and roll turn about the same axis.
constexpr double locked = 1e-7;

double nearest_turn(double angle_deg, double near_deg) {
  return angle_deg + 360.0 * std::round((near_deg - angle_deg) / 360.0);
}

glm::dvec3 nearest_turns(const glm::dvec3& angles_deg, const glm::dvec3& near_deg) {
  return {nearest_turn(angles_deg.x, near_deg.x), nearest_turn(angles_deg.y, near_deg.y),
          nearest_turn(angles_deg.z, near_deg.z)};
}

/// A turn of 30 degrees reads 30, not 30.000000000000004.
glm::dvec3 without_noise(const glm::dvec3& angles_deg) { return glm::round(angles_deg * 1e9) / 1e9 + 0.0; }

}  // namespace

glm::dquat rotation_of(const glm::dvec3& angles_deg) {
  const glm::dvec3 angles = glm::radians(angles_deg);
  return glm::normalize(glm::angleAxis(angles.y, up) * glm::angleAxis(angles.x, right) *
                        glm::angleAxis(angles.z, back));
}

glm::dvec3 angles_of(const glm::dquat& rotation, const glm::dvec3& near_deg) {
  const glm::dmat3 m = glm::mat3_cast(rotation);  // m[column][row]; of Ry Rx Rz, m[2] = (sy cx, -sx, cy cx)
  const double cosine = std::hypot(m[2].x, m[2].z);
  const double pitch = std::atan2(-m[2].y, cosine);
  if (cosine < locked) {
    // Straight up or down, only yaw -+ roll is told: roll stays what it was.
    const double sign = pitch > 0.0 ? 1.0 : -1.0;
    const double both_deg = glm::degrees(std::atan2(-m[0].z, m[0].x));  // yaw - sign * roll
    return without_noise(nearest_turns({glm::degrees(pitch), both_deg + sign * near_deg.z, near_deg.z}, near_deg));
  }
  const glm::dvec3 one = glm::degrees(glm::dvec3(pitch, std::atan2(m[2].x, m[2].z), std::atan2(m[0].y, m[1].y)));
  const glm::dvec3 near_one = nearest_turns(one, near_deg);
  const glm::dvec3 near_other = nearest_turns({180.0 - one.x, one.y + 180.0, one.z + 180.0}, near_deg);
  const auto off = [&](const glm::dvec3& angles) {
    const glm::dvec3 apart = glm::abs(angles - near_deg);
    return apart.x + apart.y + apart.z;
  };
  return without_noise(off(near_other) < off(near_one) - 1e-6 ? near_other : near_one);
}

glm::dvec2 source_of(const glm::dvec3& direction) {
  const double length = glm::length(direction);
  if (!(length > 0.0)) return {0.0, 90.0};
  const glm::dvec3 from = -direction / length;
  const double level = std::hypot(from.x, from.z);
  const glm::dvec3 told(level < locked ? 0.0 : glm::degrees(std::atan2(from.x, from.z)),
                        glm::degrees(std::atan2(from.y, level)), 0.0);
  return glm::dvec2(without_noise(told));
}

glm::dvec3 direction_from(const glm::dvec2& azimuth_elevation_deg) {
  const glm::dvec2 angles = glm::radians(azimuth_elevation_deg);
  return -glm::dvec3(std::sin(angles.x) * std::cos(angles.y), std::sin(angles.y),
                     std::cos(angles.x) * std::cos(angles.y));
}

}  // namespace focalstage
