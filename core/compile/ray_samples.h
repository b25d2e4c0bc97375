#pragma once

#include <array>

#include <glm/vec2.hpp>

namespace focalstage {

/// One of the rays that a pixel of the retina is the mean of: where it passes the pupil and where it leaves the pixel.
struct RaySample {
  glm::dvec2 pupil;  ///< in a disc of radius 1
  glm::dvec2 pixel;  ///< from the pixel's centre, within half a pixel
};

inline constexpr int rays_per_pixel = 64;

/// The same for every pixel, evenly over disc (Vogel 1979, "A better way to construct the sunflower head") and pixel
/// (Roberts 2018, the R2 sequence of the plastic number).
const std::array<RaySample, rays_per_pixel>& ray_samples();

}  // namespace focalstage
