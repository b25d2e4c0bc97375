#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

namespace focalstage {

// Light is linear in a project; whatever a person sees or writes of it is coded with sRGB's curve (IEC 61966-2-1).

/// Both 0..1. What exceeds 1 shows as 1, what is below 0 as 0.
double srgb_from_linear(double linear);
double linear_from_srgb(double coded);
glm::dvec3 srgb_from_linear(const glm::dvec3& linear);
glm::dvec3 linear_from_srgb(const glm::dvec3& coded);

/// The 8-bit code, from a table of 4096 steps: for pictures.
std::uint8_t srgb_code(double linear);

}  // namespace focalstage
