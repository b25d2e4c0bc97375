#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/base/result.h"
#include "core/mesh/texture.h"
#include "io/image/png.h"

namespace focalstage {

Result<Texture> decode_png(std::span<const std::byte> bytes, const std::string& source, PixelBits bits);
Result<Texture> decode_jpeg(std::span<const std::byte> bytes, const std::string& source);

Result<PictureHead> png_head(std::span<const std::byte> bytes, const std::string& source);
Result<PictureHead> jpeg_head(std::span<const std::byte> bytes, const std::string& source);

/// Whether a picture of that size is read at all. Asked before anything of its size is allocated.
Result<PictureHead> sized(std::uint64_t width_px, std::uint64_t height_px, const std::string& source);

/// A texture of that size, black, of 8 or 16 bits; or why there is none.
Result<Texture> blank_texture(std::uint64_t width_px, std::uint64_t height_px, const std::string& source,
                              bool deep = false);

Fault image_fault(const std::string& source, const std::string& what);

}  // namespace focalstage
