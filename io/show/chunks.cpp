#include "io/show/chunks.h"

#include <libdeflate.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>

namespace focalstage {
namespace {

struct Free {
  void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
  void operator()(libdeflate_decompressor* decompressor) const { libdeflate_free_decompressor(decompressor); }
};

/// One per thread and for the thread's life: making one costs as much as a chunk.
libdeflate_compressor* compressor() {
  thread_local const std::unique_ptr<libdeflate_compressor, Free> mine(libdeflate_alloc_compressor(compression_level));
  if (!mine) throw std::bad_alloc();
  return mine.get();
}

libdeflate_decompressor* decompressor() {
  thread_local const std::unique_ptr<libdeflate_decompressor, Free> mine(libdeflate_alloc_decompressor());
  if (!mine) throw std::bad_alloc();
  return mine.get();
}

/// The part of an image that a chunk covers.
struct Place {
  std::size_t rows;        ///< inside the image
  std::size_t row_bytes;   ///< inside the image
  std::size_t image_at;    ///< first byte in the image
  std::size_t image_step;  ///< from row to row
  std::size_t chunk_step;
};

Place place_of(const ChunkGrid& grid, std::size_t chunk) {
  const std::size_t row = chunk / grid.across * grid.rows;
  const std::size_t column = chunk % grid.across * grid.columns;
  return {std::min(grid.rows, grid.height - row), std::min(grid.columns, grid.width - column) * grid.channels,
          (row * grid.width + column) * grid.channels, grid.width * grid.channels, grid.columns * grid.channels};
}

bool is_black(std::span<const std::uint8_t> image, const Place& place) {
  for (std::size_t r = 0; r < place.rows; ++r) {
    const std::uint8_t* const row = &image[place.image_at + r * place.image_step];
    if (row[0] != 0 || std::memcmp(row, row + 1, place.row_bytes - 1) != 0) return false;
  }
  return true;
}

std::vector<std::uint8_t> packed_chunk(std::span<const std::uint8_t> image, const ChunkGrid& grid, std::size_t chunk) {
  thread_local std::vector<std::uint8_t> raw;
  thread_local std::vector<std::uint8_t> packed;
  const Place place = place_of(grid, chunk);
  if (is_black(image, place)) return {};
  raw.resize(grid.bytes());
  if (place.rows * place.row_bytes != raw.size()) std::fill(raw.begin(), raw.end(), std::uint8_t{0});
  for (std::size_t r = 0; r < place.rows; ++r)
    std::memcpy(&raw[r * place.chunk_step], &image[place.image_at + r * place.image_step], place.row_bytes);
  packed.resize(libdeflate_zlib_compress_bound(compressor(), raw.size()));
  const std::size_t size = libdeflate_zlib_compress(compressor(), raw.data(), raw.size(), packed.data(), packed.size());
  return {packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace

ChunkGrid chunk_grid(int width_px, int height_px, int channels) {
  ChunkGrid grid;
  grid.width = static_cast<std::size_t>(width_px);
  grid.height = static_cast<std::size_t>(height_px);
  grid.channels = static_cast<std::size_t>(channels);
  grid.rows = std::min<std::size_t>(chunk_rows, grid.height);
  grid.columns = std::min<std::size_t>(chunk_columns, grid.width);
  grid.down = (grid.height + grid.rows - 1) / grid.rows;
  grid.across = (grid.width + grid.columns - 1) / grid.columns;
  return grid;
}

PackedFrame pack(const FrameImages& images, const ChunkGrid& grid) {
  std::vector<std::vector<std::uint8_t>> chunks(images.count * grid.per_image());
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t i) {
    chunks[i] = packed_chunk(images.image(i / grid.per_image()), grid, i % grid.per_image());
  });
  PackedFrame frame;
  std::size_t total = 0;
  for (const auto& chunk : chunks) total += chunk.size();
  frame.data.reserve(total);
  for (const auto& chunk : chunks) {
    frame.sizes.push_back(static_cast<std::uint32_t>(chunk.size()));
    frame.data.insert(frame.data.end(), chunk.begin(), chunk.end());
  }
  return frame;
}

bool unpack(std::span<const std::uint8_t> stream, const ChunkGrid& grid, std::size_t chunk,
            std::span<std::uint8_t> image) {
  thread_local std::vector<std::uint8_t> raw;
  raw.resize(grid.bytes());
  std::size_t size = 0;
  const libdeflate_result result =
      libdeflate_zlib_decompress(decompressor(), stream.data(), stream.size(), raw.data(), raw.size(), &size);
  if (result != LIBDEFLATE_SUCCESS || size != raw.size()) return false;
  const Place place = place_of(grid, chunk);
  for (std::size_t r = 0; r < place.rows; ++r)
    std::memcpy(&image[place.image_at + r * place.image_step], &raw[r * place.chunk_step], place.row_bytes);
  return true;
}

}  // namespace focalstage
