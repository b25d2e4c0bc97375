#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "devices/camera/v4l2_calls.h"
#include "devices/roles/camera.h"

namespace focalstage {

struct V4l2Settings {
  std::string address = "/dev/video0";
  std::string bus;  ///< where it must be plugged in ("usb-0000:00:14.0-2"), wherever it is called; empty: anywhere
  int width_px = 1280;
  int height_px = 720;
  double rate_hz = 60.0;
  double exposure_s = 0.0;  ///< half of it lies between the time stamp and the exposure's middle; 0: unknown
};

/// What a camera says of itself.
struct V4l2Description {
  std::string address;
  std::string model;
  std::string bus;
};

/// Reads what is at this address, if that is a camera that can stream.
std::optional<V4l2Description> describe_v4l2(V4l2Calls& calls, const std::string& address);

/// An open camera that streams, until destroyed: buffers in its memory, pictures out of them. For one thread.
class V4l2Stream {
 public:
  /// "camera.absent", "camera.busy", "camera.format" (no gray and no YUYV), "camera.refused".
  static Result<std::unique_ptr<V4l2Stream>> open(std::shared_ptr<V4l2Calls> calls, const V4l2Settings& settings,
                                                  const std::string& address);
  ~V4l2Stream();
  V4l2Stream(const V4l2Stream&) = delete;
  V4l2Stream& operator=(const V4l2Stream&) = delete;

  /// The next picture; nothing if none came within `timeout_ms` or it was damaged; "camera.unplugged".
  Result<std::shared_ptr<const CameraFrame>> next(int timeout_ms, double now_s);

 private:
  struct Buffer {
    void* memory = nullptr;
    std::size_t length = 0;
  };

  V4l2Stream(std::shared_ptr<V4l2Calls> calls, const V4l2Settings& settings, std::string address, int descriptor)
      : calls_(std::move(calls)), settings_(settings), address_(std::move(address)), descriptor_(descriptor) {}
  Status set_format();
  void set_rate();
  Status map_buffers();
  Status begin();
  Fault refused(const std::string& what) const;
  std::shared_ptr<const CameraFrame> picture(const Buffer& buffer, std::size_t used, std::uint32_t sequence,
                                             double time_s) const;

  std::shared_ptr<V4l2Calls> calls_;
  V4l2Settings settings_;
  std::string address_;
  int descriptor_;
  std::uint32_t pixel_format_ = 0;
  std::size_t row_bytes_ = 0;
  bool streams_ = false;
  std::vector<Buffer> buffers_;
};

}  // namespace focalstage
