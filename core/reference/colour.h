#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/mesh/texture.h"
#include "core/stage/stage.h"

namespace focalstage {

/// Linear colour of `texture` at `uv`, bilinear between texel centres in linear light or the texel's own; v = 0 is the
/// bottom of the picture.
glm::dvec3 texture_colour(const Texture& texture, const glm::dvec2& uv);

/// Alpha of `texture` at `uv`, found like the colour.
double texture_alpha(const Texture& texture, const glm::dvec2& uv);

/// Whether a drawable's face is cut away by its texture's alpha at the point that its corners share by `shares`.
bool cut_away(const Drawable& drawable, std::size_t triangle, const glm::dvec3& shares);

/// Linear colour of a drawable's face at the point that its corners share by `shares`, seen from `viewer_m` (world).
glm::dvec3 colour_at(const Drawable& drawable, std::size_t triangle, const glm::dvec3& shares,
                     const glm::dvec3& viewer_m, const std::vector<Light>& lights);

/// Rec. 709 luminance of linear RGB.
double luminance(const glm::dvec3& colour);

}  // namespace focalstage
