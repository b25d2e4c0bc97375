#pragma once

#include <cstddef>
#include <cstdint>

namespace focalstage {

/// Projector pixels are worked on in square tiles; a row of a tile is one vector of the kernel.
inline constexpr int tile_side = 8;
inline constexpr int tile_samples = tile_side * tile_side;

/// How many tiles hold `samples` along one side; one at least.
constexpr int tiles_across(int samples) { return samples > tile_side ? (samples + tile_side - 1) / tile_side : 1; }

/// A rectangle of the tangent plane; empty while `min` exceeds `max`.
struct Box {
  float min_x, min_y, max_x, max_y;
};

/// How an image is cut into tiles; the last column and row may hang over its edge.
struct TileGrid {
  int width_px = 0;
  int height_px = 0;

  int columns() const { return (width_px + tile_side - 1) / tile_side; }
  int rows() const { return (height_px + tile_side - 1) / tile_side; }
  std::size_t count() const { return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows()); }
};

}  // namespace focalstage
