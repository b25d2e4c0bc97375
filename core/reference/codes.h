#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "core/compile/frame.h"

namespace focalstage {

/// The rounding of sums of weights is no clipping.
inline constexpr double full_light = 1.0 + 1e-4;

/// The code that gives this light, full white being 1 and black 0.
std::uint8_t code_of(double light, const CompileSettings& settings);

/// Counts what a pixel wants beyond full white and below black in its channels.
void count_asked(const glm::dvec3& light, int channels, SurfaceAsked& asked);
void add(const SurfaceAsked& row, SurfaceAsked& sum);

}  // namespace focalstage
