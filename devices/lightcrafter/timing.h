#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// What the controller cannot go below or beyond (TI SDK, `Exposure::MININUM`, `lcr4500.hpp`; user's guide DLPU011).
namespace focalstage::lightcrafter {

inline constexpr int width_px = 912;
inline constexpr int height_px = 1140;

/// Time that it needs in the dark: between exposures that do not touch, and before the next vsync.
inline constexpr std::uint32_t dark_us = 230;
inline constexpr std::uint32_t longest_us = 200'000'000;
inline constexpr int most_entries = 1824;

/// Least exposure of a pattern of 1..8 bits.
constexpr std::uint32_t least_exposure_us(int bits) {
  constexpr std::array<std::uint32_t, 8> least{235, 700, 1570, 1700, 2000, 2500, 4500, 8333};
  return least[static_cast<std::size_t>(bits - 1)];
}

}  // namespace focalstage::lightcrafter
