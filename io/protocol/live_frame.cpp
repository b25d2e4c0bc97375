#include <cstddef>
#include <fstream>

#include "io/protocol/live_values.h"

namespace focalstage {

namespace {

constexpr int most_images = 4096;
constexpr int most_side_px = 16384;

bool possible(const LiveCompiled& compiled) {
  return compiled.images >= 0 && compiled.images <= most_images && compiled.width_px >= 1 &&
         compiled.width_px <= most_side_px && compiled.height_px >= 1 && compiled.height_px <= most_side_px &&
         (compiled.channels == 1 || compiled.channels == 3);
}

}  // namespace

Result<FrameImages> read_live_frame(const LiveCompiled& compiled) {
  if (compiled.frame_file.empty()) {
    return Fault{"live.frame-gone", "frame", "the rig shares no frames", "start the link with share_frames"};
  }
  if (!possible(compiled)) return Fault{"live.frame-gone", compiled.frame_file, "its size is no frame's", ""};
  FrameImages images;
  images.count = static_cast<std::size_t>(compiled.images);
  images.width_px = compiled.width_px;
  images.height_px = compiled.height_px;
  images.channels = compiled.channels;
  std::ifstream file(compiled.frame_file, std::ios::binary | std::ios::ate);
  const std::size_t wanted = images.count * images.bytes_per_image();
  if (!file || static_cast<std::size_t>(file.tellg()) != wanted) {
    return Fault{"live.frame-gone", compiled.frame_file, "newer frames took its place", "take the next one"};
  }
  images.codes.resize(wanted);
  file.seekg(0);
  file.read(reinterpret_cast<char*>(images.codes.data()), static_cast<std::streamsize>(wanted));
  if (file) return images;
  return Fault{"live.frame-gone", compiled.frame_file, "it could not be read", "take the next one"};
}

}  // namespace focalstage
