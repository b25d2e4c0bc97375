#pragma once

#include <limits>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "core/optics/eye.h"
#include "tests/bench/scenes.h"

namespace focalstage::bench {

/// A rectangle of the eye's tangent plane.
struct Window {
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};
};

/// All that an eye can look at, through all slices.
Window window_of(const BenchScene& scene, const Eye& eye);

/// Clip space of a window of the tangent plane; the first row of the image is its lowest.
glm::dmat4 clip_from_eye(const Window& window);

/// Clip space of the projector's image; its first row is its top, so that bytes are read back in the show's order.
glm::dmat4 clip_from_projector(const ProjectorModel& projector);

}  // namespace focalstage::bench
