#pragma once

#include <memory>

#include "core/base/result.h"
#include "core/mesh/texture.h"

namespace focalstage {

/// How the pixels of a picture are to be understood.
struct TextureUse {
  Wrap wrap = Wrap::clamp;
  Magnify filter = Magnify::linear;
  ColorSpace color_space = ColorSpace::srgb;

  bool operator==(const TextureUse&) const = default;
};

/// A picture whose pixels are made when they are asked for: of a long sequence only a few are in memory.
class StoredPicture {
 public:
  virtual ~StoredPicture() = default;

  /// Its pixels. As long as somebody holds what an earlier call gave, the same picture for the same use is the same
  /// texture at the same address. Any thread. Faults "image.*", with the name of the file.
  virtual Result<std::shared_ptr<const Texture>> texture(const TextureUse& use) const = 0;
};

}  // namespace focalstage
