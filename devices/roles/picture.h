#pragma once

#include <cstdint>
#include <memory>
#include <span>

namespace focalstage {

/// One image as it travels to a projector: codes row by row from the top left, channels interleaved; `owner` keeps the
/// bytes alive.
struct Picture {
  std::shared_ptr<const void> owner;
  std::span<const std::uint8_t> codes;
};

/// How the codes of pictures are read.
struct PictureForm {
  int channels = 1;  ///< 1 gray, 3 RGB
  int bits = 8;      ///< of each code: full light is 2^bits - 1

  bool operator==(const PictureForm&) const = default;
};

/// The same bytes, wherever they lie.
bool same_picture(const Picture& a, const Picture& b);

}  // namespace focalstage
