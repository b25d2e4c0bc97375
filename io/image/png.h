#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/mesh/texture.h"

namespace focalstage {

/// Writes 8-bit gray (1 channel) or RGB (3) rows from the top, atomically.
Status write_png(const std::filesystem::path& path, int width_px, int height_px, int channels,
                 std::span<const std::uint8_t> codes);

/// PNG or JPEG bytes as 8-bit RGBA; at most 16384 pixels a side. `source` names it in faults ("image.invalid").
Result<Texture> decode_image(std::span<const std::byte> bytes, const std::string& source);

}  // namespace focalstage
