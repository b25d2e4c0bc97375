#pragma once

#include <cstdint>
#include <vector>

namespace focalstage {

/// How a texture continues beyond its edge.
enum class Wrap { repeat, mirror, clamp };

/// What is seen between the centres of a texture's pixels.
enum class Magnify { linear, nearest };

/// A picture of 8-bit sRGB colours with linear alpha, four bytes a pixel, rows from the top.
struct Texture {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgba;
  Wrap wrap_u = Wrap::repeat;
  Wrap wrap_v = Wrap::repeat;
  Magnify magnify = Magnify::linear;

  bool operator==(const Texture&) const = default;
};

}  // namespace focalstage
