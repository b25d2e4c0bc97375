#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

namespace focalstage {

/// "#ff8000" of a linear colour, and back; "f80" and without "#" too.
std::string colour_text(const glm::dvec3& linear);
std::optional<glm::dvec3> typed_colour(std::string_view text);

}  // namespace focalstage
