#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/mesh/texture.h"

namespace focalstage {

/// A texture at `uv` in linear light: bilinear between texel centres or the texel it falls in, as the texture says;
/// v = 0 at the bottom row.
glm::dvec3 sample_texture(const Texture& texture, const glm::dvec2& uv);

/// The texture's alpha there, likewise.
double sample_alpha(const Texture& texture, const glm::dvec2& uv);

}  // namespace focalstage
