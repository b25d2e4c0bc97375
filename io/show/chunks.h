#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/compile/frame.h"
#include "io/show/show.h"

namespace focalstage {

// Measured on twelve images of 1024x768 (docs/decisions): smaller chunks leave more black unwritten, larger ones cost
// less per chunk; 64 x 256 is fastest. Level 1 is within 8 % of level 3 in size.
inline constexpr int chunk_rows = 64;
inline constexpr int chunk_columns = 256;
inline constexpr int compression_level = 1;

/// How an image is cut into chunks; those at the right and lower edge are padded with black to the full shape.
struct ChunkGrid {
  std::size_t width = 0;  ///< of the image, in pixels
  std::size_t height = 0;
  std::size_t channels = 1;
  std::size_t rows = 0;  ///< of a chunk
  std::size_t columns = 0;
  std::size_t down = 0;  ///< chunks of an image
  std::size_t across = 0;

  std::size_t per_image() const { return down * across; }
  std::size_t bytes() const { return rows * columns * channels; }
};

ChunkGrid chunk_grid(int width_px, int height_px, int channels);

/// The images of one frame as zlib streams, chunk after chunk in image, row, column order; a black chunk has size 0.
struct PackedFrame {
  std::vector<std::uint32_t> sizes;
  std::vector<std::uint8_t> data;
};

/// In parallel within the calling thread's arena; the bytes do not depend on it.
PackedFrame pack(const FrameImages& images, const ChunkGrid& grid);

/// Inflates `stream` and puts the chunk number `chunk` where it belongs in `image`; false where it is damaged.
bool unpack(std::span<const std::uint8_t> stream, const ChunkGrid& grid, std::size_t chunk,
            std::span<std::uint8_t> image);

}  // namespace focalstage
