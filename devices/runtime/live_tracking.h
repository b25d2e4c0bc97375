#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <thread>

#include "core/base/result.h"
#include "devices/roles/rig.h"
#include "devices/runtime/body_tracks.h"
#include "devices/runtime/pose_delay.h"

namespace focalstage {

/// A rig's tracker, where it stands, and how things hang on its bodies.
struct TrackerSetup {
  std::shared_ptr<Tracker> tracker;  ///< none: projects with `track` are refused when they are live
  DeviceId id;                       ///< for people
  Rigid world_from_tracker;
  BodyMounts body_from_thing;
  MotionLimits motion;
};

/// A project with tracked things where they will be when its light comes.
struct PosedProject {
  std::shared_ptr<const Project> project;
  std::set<std::string> bodies;
  std::uint64_t frame = 0;  ///< of the tracker, as BodyTracks counts
  double seen_s = 0.0;
  double taken_s = 0.0;
};

/// Follows a tracker in a thread of its own, says where things will be, and doubts where bodies that are watched are
/// not seen.
class LiveTracking {
 public:
  /// `lead_s`: how long light takes, until it is measured. `doubt` is called again and again while there is one.
  LiveTracking(TrackerSetup setup, double lead_s, std::function<void(const Fault&)> doubt);
  ~LiveTracking();

  /// The tracker's own faults.
  Status start();

  /// "track.unknown", "track.unseen".
  Result<PosedProject> pose(const Project& project) const;

  /// The tracker's newest frame, as PosedProject::frame counts; 0 before the first.
  std::uint64_t newest() const;

  /// What plays from now on stands at these bodies.
  void watch(std::set<std::string> bodies);

  /// The tracker as a part of the rig: off until it was heard for the first time.
  RigPart part() const;

  /// Outlives this in the shows that report their light to it.
  const std::shared_ptr<PoseDelay>& delay() const { return delay_; }

 private:
  void run(const std::stop_token& stop);
  std::optional<Fault> step();

  TrackerSetup setup_;
  std::function<void(const Fault&)> doubt_;
  std::shared_ptr<PoseDelay> delay_;
  mutable std::mutex mutex_;
  BodyTracks tracks_;
  std::shared_ptr<const TrackedFrame> taken_;
  std::set<std::string> watched_;
  std::jthread thread_;
};

}  // namespace focalstage
