#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/sides.h"
#include "editor/preview/preview_values.h"

namespace focalstage {

/// Which slices light each pixel for one eye: the slices' colours (`colour_of`, by the slice's index in the project,
/// 0..1) weighted by the light each gives. Rows from the top, three codes a pixel.
std::vector<std::uint8_t> assignment_picture(const CompiledSlices& compiled, Side side,
                                             std::span<const glm::dvec3> slice_colours);

/// What compensation changes: amber where `with` is brighter, blue where `without` is; gray images of the same size.
std::vector<std::uint8_t> difference_picture(std::span<const std::uint8_t> with, std::span<const std::uint8_t> without,
                                             int channels);

}  // namespace focalstage
