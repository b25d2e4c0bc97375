#pragma once

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

/// An 8-bit gray picture, rows from the top without padding.
struct GrayImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> gray;

  bool operator==(const GrayImage&) const = default;
};

/// A binary PGM ("P5") of 8 bits (netpbm.sourceforge.net/doc/pgm.html): the one picture format that takes no library
/// and that every tool writes. "camera.picture" with the file and the reason; at most 16384 pixels a side.
Result<GrayImage> read_pgm(const std::string& path);

/// The same of bytes that `name` is what faults call.
Result<GrayImage> read_pgm(std::istream& bytes, const std::string& name);

/// "camera.unwritable".
Status write_pgm(const std::string& path, const GrayImage& image);

}  // namespace focalstage
