#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace focalstage {

/// A turn told as a person does, in degrees: yaw about the world's upright, then pitch about the thing's own right,
/// then roll about its own depth axis. x pitch, y yaw, z roll.
glm::dquat rotation_of(const glm::dvec3& pitch_yaw_roll_deg);

/// The angles of a turn. Many mean the same; these are the nearest to `near_deg`, so that a dial that is turned on past
/// straight up does not jump.
glm::dvec3 angles_of(const glm::dquat& rotation, const glm::dvec3& near_deg = glm::dvec3(0.0));

/// Where light comes from: azimuth from +Z (behind a viewer) towards +X (the right), and elevation above the horizon.
/// `direction` is the way it travels.
glm::dvec2 source_of(const glm::dvec3& direction);
glm::dvec3 direction_from(const glm::dvec2& azimuth_elevation_deg);

}  // namespace focalstage
