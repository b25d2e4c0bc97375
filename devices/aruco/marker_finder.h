#pragma once

#include <memory>
#include <vector>

#include "core/base/result.h"
#include "devices/aruco/settings.h"
#include "devices/roles/camera.h"
#include "devices/roles/tracker.h"

namespace focalstage {

/// Finds bodies in pictures. Poses are in the tracker's frame: the camera's, turned to +Y up, so that it looks along
/// -Z. For one thread at a time.
class MarkerFinder {
 public:
  /// "aruco.settings": no such dictionary, a marker it has not got or that two bodies carry, an even number of rows, a
  /// size or camera that cannot be.
  static Result<MarkerFinder> make(const ArucoSettings& settings);

  MarkerFinder(MarkerFinder&&) noexcept;
  MarkerFinder& operator=(MarkerFinder&&) noexcept;
  ~MarkerFinder();

  /// All bodies of the settings, in their order. `mean_error_m` is the reprojection's root mean square at the body's
  /// distance.
  std::vector<TrackedBody> find(const CameraFrame& frame);

 private:
  struct State;
  explicit MarkerFinder(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
