#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

namespace focalstage {

/// Colours are linear in a project and coded with sRGB's curve wherever a person sees or writes them. What exceeds 1
/// shows as 1.
glm::dvec3 coded_from_linear(const glm::dvec3& linear);
glm::dvec3 linear_from_coded(const glm::dvec3& coded);

/// "#ff8000" of a linear colour, and back; "f80" and without "#" too.
std::string colour_text(const glm::dvec3& linear);
std::optional<glm::dvec3> typed_colour(std::string_view text);

}  // namespace focalstage
