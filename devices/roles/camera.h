#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "devices/roles/device.h"

namespace focalstage {

/// One picture of a camera, 8-bit gray, rows from the top without padding.
struct CameraFrame {
  int width_px = 0;
  int height_px = 0;
  std::uint64_t number = 0;  ///< of the camera's own count: a gap is a frame that was lost
  double time_s = 0.0;       ///< of the exposure's middle as well as it is known, on the monotonic clock
  std::vector<std::uint8_t> gray;
};

/// What sees: a camera, or a recording of one. Runs from `open` on.
class Camera : public Device {
 public:
  /// The newest frame; null before the first, and where the camera is lost.
  virtual std::shared_ptr<const CameraFrame> newest() const = 0;
};

}  // namespace focalstage
