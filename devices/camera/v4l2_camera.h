#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "devices/camera/v4l2_calls.h"
#include "devices/camera/v4l2_stream.h"
#include "devices/roles/camera.h"

namespace focalstage {

/// The cameras that are plugged in: /dev/video0 to /dev/video63.
std::vector<DeviceId> probe_v4l2(V4l2Calls& calls);

/// A camera of this machine. Once unplugged, or silent for a second, it is lost; `open` looks for it again, by its bus
/// where that was told, at every address.
class V4l2Camera final : public Camera {
 public:
  explicit V4l2Camera(V4l2Settings settings, std::shared_ptr<V4l2Calls> calls = kernel_v4l2());
  ~V4l2Camera() override { close(); }

  Status open() override;
  void close() override;
  DeviceId id() const override;
  DeviceState state() const override;

  /// Refused: a camera has nothing to show.
  Status identify() override;
  std::shared_ptr<const CameraFrame> newest() const override;

 private:
  Result<V4l2Description> find() const;
  void run(const std::stop_token& stop);

  V4l2Settings settings_;
  std::shared_ptr<V4l2Calls> calls_;
  std::mutex opening_;  ///< open and close, one after the other
  std::unique_ptr<V4l2Stream> stream_;
  mutable std::mutex mutex_;
  V4l2Description found_;
  DeviceState state_;
  std::shared_ptr<const CameraFrame> newest_;
  std::jthread thread_;
};

}  // namespace focalstage
