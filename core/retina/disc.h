#pragma once

#include <cstddef>
#include <vector>

namespace focalstage {

/// The parts of a disc's light that fall on the pixels around its centre; they sum to one.
struct Disc {
  int reach_px = 0;
  std::vector<float> share;  ///< [2 reach + 1][2 reach + 1]

  const float* row(int dy) const {
    return &share[static_cast<std::size_t>((dy + reach_px) * (2 * reach_px + 1) + reach_px)];
  }
};

/// A disc of `radius_px` about a pixel's centre; 0: all in that pixel.
Disc disc_of(double radius_px);

/// Adds `from`, each value spread over `disc`, to `onto`: two planes of the same size. What leaves the plane is lost.
void add_spread(const Disc& disc, const float* from, int width_px, int height_px, float* onto);

}  // namespace focalstage
