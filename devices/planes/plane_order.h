#pragma once

#include <cstdint>

namespace focalstage {

/// The bit planes of a 24-bit video pixel that a DLPC350 shows as one pattern, consecutive in its plane order
/// G0..G7 R0..R7 B0..B7; the highest is the pattern's most significant bit.
struct PlaneSpan {
  int first = 0;
  int count = 0;

  bool operator==(const PlaneSpan&) const = default;
};

/// How many patterns of a depth, 1..8 bits, one video frame holds: 24, 12, 8, 6, 4, 4, 3, 3.
int most_patterns(int bits);

/// Which planes pattern `number` (0..most_patterns - 1) of that depth covers (TI's numbering: DLPC350 SDK,
/// lcr4500.hpp).
PlaneSpan planes_of(int bits, int number);

/// The pixel 0x00RRGGBB whose planes are the bits of `planes` in plane order.
constexpr std::uint32_t pixel_of(std::uint32_t planes) {
  return (planes & 0xFF00U) << 8 | (planes & 0xFFU) << 8 | (planes >> 16 & 0xFFU);
}

/// The other way round.
constexpr std::uint32_t planes_in(std::uint32_t pixel) {
  return (pixel >> 8 & 0xFFU) | (pixel >> 8 & 0xFF00U) | (pixel & 0xFFU) << 16;
}

}  // namespace focalstage
