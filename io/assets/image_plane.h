#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

/// Whether the name of a file says that it is a picture that `image_plane` takes.
bool is_picture(const std::filesystem::path& file);

/// A picture (PNG or JPEG, as it is) as a GLB file: a plane 1 m wide, as high as the picture asks for, centred, facing
/// +Z, unlit. Fault "image.*" where the picture cannot be read.
Result<std::vector<std::byte>> image_plane(std::span<const std::byte> picture, const std::filesystem::path& name);

}  // namespace focalstage
