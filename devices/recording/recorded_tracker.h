#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "devices/recording/recording_text.h"
#include "devices/roles/clock.h"
#include "devices/roles/tracker.h"

namespace focalstage {

struct ReplaySettings {
  bool loop = false;                            ///< begins again after the last frame; else the tracker is lost then
  double silence_s = 0.1;                       ///< without a frame for so long, it is lost, as the one recorded was
  std::function<double()> now_s = monotonic_s;  ///< its clock: real time, or whatever is told
};

/// A tracker that says again what another said: each frame as long after `start` as it came after the first. Frames
/// tell the times of now, everything else is as it was recorded. It needs no thread: what is newest follows from the
/// clock.
class RecordedTracker final : public Tracker {
 public:
  explicit RecordedTracker(TrackerRecording recording, ReplaySettings settings = {});

  Status start() override;
  void stop() override;
  std::shared_ptr<const TrackedFrame> newest() const override;
  TrackerState state() const override;

 private:
  double lap_s(double TrackedFrame::*clock) const;
  std::uint64_t frames_by(double now_s) const;

  TrackerRecording recording_;
  ReplaySettings settings_;
  mutable std::mutex mutex_;
  std::optional<double> started_s_;
  mutable std::uint64_t told_ = 0;  ///< frames by then, of which `newest_` is the last
  mutable std::shared_ptr<const TrackedFrame> newest_;
};

}  // namespace focalstage
