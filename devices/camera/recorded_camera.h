#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "devices/camera/pgm.h"
#include "devices/roles/camera.h"
#include "devices/roles/clock.h"

namespace focalstage {

struct RecordedCameraSettings {
  std::string folder;     ///< of *.pgm, shown in the order of their names
  double rate_hz = 30.0;  ///< pictures per second
  bool loop = false;      ///< begins again after the last; else it is lost then
  std::function<double()> now_s = monotonic_s;
};

/// A camera that shows what was recorded: one picture after the other, from `open` on.
class RecordedCamera final : public Camera {
 public:
  explicit RecordedCamera(RecordedCameraSettings settings) : settings_(std::move(settings)) {}

  /// "camera.folder": there is none, or no picture in it. A picture that can't be read is a loss when its turn comes.
  Status open() override;
  void close() override;
  DeviceId id() const override { return {"camera", "recording", "", settings_.folder}; }
  DeviceState state() const override;
  Status identify() override;
  std::shared_ptr<const CameraFrame> newest() const override;

 private:
  /// Whose turn it is, counted from 0; none once it is at the end.
  std::optional<std::uint64_t> turn() const;
  void load(std::uint64_t turn) const;

  RecordedCameraSettings settings_;
  mutable std::mutex mutex_;
  std::vector<std::string> paths_;
  std::optional<double> opened_s_;
  mutable std::shared_ptr<const CameraFrame> newest_;
  mutable std::optional<Fault> fault_;
};

}  // namespace focalstage
