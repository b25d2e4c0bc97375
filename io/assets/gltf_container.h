#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/base/result.h"

namespace focalstage {

/// The JSON text inside a .gltf (all of it) or a .glb (its first chunk), and a .glb's binary chunk, the container
/// checked. What no parser should be given (over 64 levels deep, over two million values) is refused here.
struct GltfText {
  std::span<const std::byte> json;
  std::span<const std::byte> binary;
};
Result<GltfText> gltf_text(std::span<const std::byte> bytes, const std::string& path);

}  // namespace focalstage
