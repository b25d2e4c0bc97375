#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace focalstage {

/// Thresholds 0..255, each 16 times, so that those below any level lie evenly and without visible texture (Ulichney,
/// "The void-and-cluster method for dither array generation", 1993). Tiles the plane.
struct BlueNoise {
  static constexpr std::size_t size = 64;
  std::array<std::uint8_t, size * size> thresholds{};  ///< row by row
};

/// Made at the first call (tens of milliseconds), the same on every machine; kept.
const BlueNoise& blue_noise();

/// Makes one of a seed of one's own: `blue_noise()` is that of seed 1.
BlueNoise make_blue_noise(std::uint64_t seed);

}  // namespace focalstage
