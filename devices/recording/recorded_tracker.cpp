#include "devices/recording/recorded_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace focalstage {

RecordedTracker::RecordedTracker(TrackerRecording recording, ReplaySettings settings)
    : recording_(std::move(recording)), settings_(std::move(settings)) {}

Status RecordedTracker::start() {
  if (recording_.empty()) return Fault{"recording.empty", "recording", "it holds no frame", "choose another"};
  const std::lock_guard lock(mutex_);
  if (!started_s_) started_s_ = settings_.now_s();
  return {};
}

void RecordedTracker::stop() {
  const std::lock_guard lock(mutex_);
  started_s_.reset();
  newest_.reset();
  told_ = 0;
}

/// From the first frame to the first frame again: the step from the last to it is as long as one on the average.
double RecordedTracker::lap_s(double TrackedFrame::*clock) const {
  const double length_s = recording_.back().*clock - recording_.front().*clock;
  const double steps = static_cast<double>(recording_.size() - 1);
  return steps > 0.0 && length_s > 0.0 ? length_s * (steps + 1.0) / steps : 1.0;
}

std::uint64_t RecordedTracker::frames_by(double now_s) const {
  double passed_s = std::max(now_s - *started_s_, 0.0);
  std::uint64_t before = 0;
  if (settings_.loop) {
    const double lap = lap_s(&TrackedFrame::arrival_s);
    const double laps = std::floor(passed_s / lap);
    passed_s -= laps * lap;
    before = static_cast<std::uint64_t>(laps) * recording_.size();
  }
  const double first_s = recording_.front().arrival_s;
  const auto later = [&](double passed, const TrackedFrame& frame) { return passed < frame.arrival_s - first_s; };
  const auto next = std::upper_bound(recording_.begin(), recording_.end(), passed_s, later);
  // Where rounding puts the very beginning before the first frame, it is there all the same.
  return before + std::max<std::uint64_t>(static_cast<std::uint64_t>(next - recording_.begin()), 1);
}

std::shared_ptr<const TrackedFrame> RecordedTracker::newest() const {
  const std::lock_guard lock(mutex_);
  if (!started_s_) return nullptr;
  const std::uint64_t count = frames_by(settings_.now_s());
  if (newest_ && told_ == count) return newest_;
  const std::uint64_t laps = (count - 1) / recording_.size();
  const TrackedFrame& first = recording_.front();
  TrackedFrame frame = recording_[(count - 1) % recording_.size()];
  const double lap_number = static_cast<double>(laps);
  frame.arrival_s += *started_s_ - first.arrival_s + lap_number * lap_s(&TrackedFrame::arrival_s);
  frame.time_s += lap_number * lap_s(&TrackedFrame::time_s);
  frame.number += static_cast<std::int64_t>(laps) * (recording_.back().number - first.number + 1);
  newest_ = std::make_shared<const TrackedFrame>(std::move(frame));
  told_ = count;
  return newest_;
}

TrackerState RecordedTracker::state() const {
  const auto frame = newest();
  const std::lock_guard lock(mutex_);
  TrackerState state;
  if (!started_s_ || !frame) return state;
  state.frames = told_;
  state.phase = TrackerPhase::tracking;
  if (settings_.now_s() - frame->arrival_s <= settings_.silence_s) return state;
  state.phase = TrackerPhase::lost;
  const bool ended = !settings_.loop && told_ >= recording_.size();
  state.fault = ended
                    ? Fault{"recording.ended", "recording", "the recording is at its end", "start it again, or loop it"}
                    : Fault{"recording.silent", "recording", "no frame came then either", "wait"};
  return state;
}

}  // namespace focalstage
