#pragma once

#include <cstdint>
#include <vector>

namespace focalstage {

/// How a texture continues beyond its edge.
enum class Wrap { repeat, mirror, clamp };

/// What is seen between the centres of a texture's pixels.
enum class Magnify { linear, nearest };

/// How a texture's numbers stand for light: encoded as IEC 61966-2-1 says, or in proportion to it.
enum class ColorSpace { srgb, linear };

/// A picture of colours with linear alpha, four numbers a pixel, rows from the top: 8 bits each, or 16 in place of
/// them.
struct Texture {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgba;
  Wrap wrap_u = Wrap::repeat;
  Wrap wrap_v = Wrap::repeat;
  Magnify magnify = Magnify::linear;
  std::vector<std::uint16_t> rgba16{};  ///< where the file has more than 8 bits; `rgba` is empty then
  ColorSpace color_space = ColorSpace::srgb;

  bool is_deep() const { return !rgba16.empty(); }

  bool operator==(const Texture&) const = default;
};

}  // namespace focalstage
