#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "core/base/result.h"
#include "core/tracking/motion.h"
#include "core/tracking/placed.h"
#include "devices/roles/tracker.h"

namespace focalstage {

/// All that is known of a tracker's bodies, by name; one without a name goes by its number. Told the time: knows
/// neither clock nor thread. For one thread at a time.
class BodyTracks {
 public:
  explicit BodyTracks(const MotionLimits& limits = {}) : limits_(limits) {}

  void take(const TrackedFrame& frame);

  /// Tracker from body, predicted for `time_s`; none for those not seen in the newest frame.
  BodyPoses at(double time_s) const;

  /// Which frame is the newest, counted as they were taken, and when its light fell; none before the first.
  struct Moment {
    std::uint64_t count = 0;
    double seen_s = 0.0;
  };
  std::optional<Moment> newest() const { return newest_; }

  /// "rig.tracker" where one of these bodies was not seen for `allowed_s`, or never.
  std::optional<Fault> doubt(const std::set<std::string>& bodies, const TrackerState& tracker, double now_s,
                             double allowed_s) const;

 private:
  struct Track {
    Motion motion;
    std::optional<double> tracked_s;  ///< when the newest frame came that saw it
  };

  MotionLimits limits_;
  std::map<std::string, Track> tracks_;
  std::optional<Moment> newest_;
};

}  // namespace focalstage
