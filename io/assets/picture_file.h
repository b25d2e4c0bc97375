#pragma once

#include <memory>

#include "core/base/result.h"
#include "core/mesh/stored_picture.h"
#include "io/assets/assets.h"

namespace focalstage {

/// A picture of a project, and what its first bytes say.
struct PictureFile {
  std::shared_ptr<const StoredPicture> picture;
  int width_px = 0;
  int height_px = 0;
};

/// Looks at the head of a PNG or JPEG; its pixels are made when they are asked for. What is not in use keeps at most
/// 256 MiB of memory, for all pictures of the process; the least lately asked for go first. Faults "image.*".
Result<PictureFile> open_picture(const AssetFile& file);

}  // namespace focalstage
