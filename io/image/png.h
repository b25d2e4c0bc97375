#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/mesh/texture.h"

namespace focalstage {

/// 8-bit gray (1 channel) or RGB (3) rows from the top as the bytes of a PNG: no dates, no comments, the same for the
/// same picture. Code "image.invalid" where the numbers don't fit together.
Result<std::vector<std::byte>> encode_png(int width_px, int height_px, int channels,
                                          std::span<const std::uint8_t> codes);

/// Writes 8-bit gray (1 channel) or RGB (3) rows from the top, atomically.
Status write_png(const std::filesystem::path& path, int width_px, int height_px, int channels,
                 std::span<const std::uint8_t> codes);

/// Writes 16-bit gray or RGB rows of linear light from the top, atomically; says in the file that it is linear, so that
/// viewers show it right.
Status write_png16(const std::filesystem::path& path, int width_px, int height_px, int channels,
                   std::span<const std::uint16_t> light);

/// How many bits of a pixel's numbers are kept.
enum class PixelBits {
  eight,     ///< scaled to 8
  as_stored  ///< 16 where the file has 16
};

/// PNG or JPEG bytes as RGBA; at most 16384 pixels a side and 2^26 in all. The numbers of the file: gamma, colour
/// profile and orientation tags are ignored, as glTF demands. `source` names it in faults ("image.invalid",
/// "image.too-large", "image.unsupported").
Result<Texture> decode_image(std::span<const std::byte> bytes, const std::string& source,
                             PixelBits bits = PixelBits::eight);

struct PictureHead {
  int width_px = 0;
  int height_px = 0;
};

/// What a PNG or JPEG says of itself before its pixels, within the limits of `decode_image`; that a PNG is there to its
/// end. Faults likewise.
Result<PictureHead> picture_head(std::span<const std::byte> bytes, const std::string& source);

}  // namespace focalstage
