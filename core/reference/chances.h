#pragma once

#include <array>

namespace focalstage {

/// The numbers that one ray needs, each in [0, 1).
using Chances = std::array<double, 9>;

/// A Halton sequence over the rays of a pixel, turned by a hash of the pixel.
Chances chances_of(int pixel, int ray);

}  // namespace focalstage
