#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/base/result.h"
#include "core/mesh/texture.h"

namespace focalstage {

Result<Texture> decode_png(std::span<const std::byte> bytes, const std::string& source);
Result<Texture> decode_jpeg(std::span<const std::byte> bytes, const std::string& source);

/// A texture of that size, black; or why there is none. Asked before anything of the picture's size is allocated.
Result<Texture> blank_texture(std::uint64_t width_px, std::uint64_t height_px, const std::string& source);

Fault image_fault(const std::string& source, const std::string& what);

}  // namespace focalstage
