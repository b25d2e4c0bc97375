#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "devices/aruco/marker_finder.h"
#include "devices/roles/camera.h"
#include "devices/roles/tracker.h"

namespace focalstage {

/// A camera that sees markers, as a tracker. Where the camera is lost, or was not there from the start, so is the
/// tracker, and it is opened again once a second.
class ArucoTracker final : public Tracker {
 public:
  ArucoTracker(std::shared_ptr<Camera> camera, ArucoSettings settings)
      : camera_(std::move(camera)), settings_(std::move(settings)) {}
  ~ArucoTracker() override { stop(); }

  /// "aruco.settings" and the camera's own faults, but for "camera.absent": it may yet be plugged in.
  Status start() override;
  void stop() override;
  std::shared_ptr<const TrackedFrame> newest() const override;
  TrackerState state() const override;

 private:
  void run(const std::stop_token& stop);
  void see(const CameraFrame& frame);

  std::shared_ptr<Camera> camera_;
  ArucoSettings settings_;
  std::mutex starting_;
  std::optional<MarkerFinder> finder_;  // of the thread alone
  mutable std::mutex mutex_;
  bool started_ = false;
  std::optional<Fault> absent_;  ///< why the camera could not be opened
  std::uint64_t frames_ = 0;
  std::uint64_t lost_pictures_ = 0;
  std::shared_ptr<const TrackedFrame> newest_;
  std::jthread thread_;
};

}  // namespace focalstage
