#pragma once

#include <cstdint>
#include <vector>

namespace focalstage {

/// How one picture lies on another: moved, turned, scaled, brighter.
struct PictureShift {
  double moved_px = 0.0;     ///< root mean square over the places looked at
  double doubt_px = 0.0;     ///< standard deviation of it, from what is left
  double gain = 1.0;         ///< brightness of the other, of the first's
  double unexplained = 0.0;  ///< what is left, root mean square, over the first's own spread
};

/// By least squares over the pixels of `where` (not 0), to first order (B. Lucas, T. Kanade, "An iterative image
/// registration technique", 1981): good for moves of a pixel or so; a larger one is seen as large, not measured.
PictureShift picture_shift(const std::vector<float>& first, const std::vector<float>& other,
                           const std::vector<std::uint8_t>& where, int width_px, int height_px);

}  // namespace focalstage
