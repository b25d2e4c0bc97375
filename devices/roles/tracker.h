#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/rigid.h"

namespace focalstage {

/// One body as a tracker saw it.
struct TrackedBody {
  std::int32_t id = 0;        ///< the tracker's own number
  std::string name;           ///< the tracker's name for it; empty while that is unknown
  bool tracked = false;       ///< seen in this very frame: where false, nothing may be steered by the pose
  Rigid tracker_from_body;    ///< right-handed, +Y up; the identity where not tracked
  double mean_error_m = 0.0;  ///< of the markers, as the tracker states it

  bool operator==(const TrackedBody&) const = default;
};

/// All bodies at one moment.
struct TrackedFrame {
  std::int64_t number = 0;          ///< the tracker's count
  double time_s = 0.0;              ///< when it was seen, on the tracker's clock
  std::optional<double> latency_s;  ///< from light on the sensors to the frame's leaving the tracker; none if not told
  double arrival_s = 0.0;           ///< when it came here, on our monotonic clock
  std::vector<TrackedBody> bodies;

  bool operator==(const TrackedFrame&) const = default;
};

enum class TrackerPhase {
  off,       ///< not started, or stopped
  seeking,   ///< nobody answered yet, or no frame came yet
  tracking,  ///< the newest frame is fresh
  lost,      ///< frames came and then no more: see the fault
  refused,   ///< what came cannot be used, and waiting will not mend it: see the fault
};

/// How a tracker stands now.
struct TrackerState {
  TrackerPhase phase = TrackerPhase::off;
  std::optional<Fault> fault;
  std::uint64_t frames = 0;   ///< taken
  std::uint64_t late = 0;     ///< dropped: a newer frame had been taken before
  std::uint64_t damaged = 0;  ///< dropped: what came was no whole message
};

/// What tells where bodies are: a motion capture system, a camera with markers, a recording. It works in a thread of
/// its own; no call waits for it or throws, and every call may come from any thread.
class Tracker {
 public:
  virtual ~Tracker() = default;

  /// Begins to seek. A fault only if this machine cannot (a port is taken); a tracker that is silent is a state.
  virtual Status start() = 0;
  virtual void stop() = 0;

  /// The newest frame, also when the tracker is lost: `state` says whether it may still be used. Null before the first.
  virtual std::shared_ptr<const TrackedFrame> newest() const = 0;
  virtual TrackerState state() const = 0;
};

}  // namespace focalstage
