#pragma once

#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include "core/stage/stage.h"

namespace focalstage {

/// What share of the light on a surface's drawable comes back, linear, each 0 to 1: at the point of a triangle that its
/// corners share by `weights`, which sum to one.
glm::dvec3 albedo_at(const Drawable& drawable, std::uint32_t triangle, const glm::dvec3& weights);

/// The same where it is one colour all over; none where it is not.
std::optional<glm::dvec3> even_albedo(const Drawable& drawable);

/// How the corners of a triangle share a point of its plane; of one without area the first has it all.
glm::dvec3 corner_weights(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& point);

}  // namespace focalstage
