#include "devices/aruco/aruco_tracker.h"

#include <chrono>
#include <system_error>
#include <utility>

#include "devices/roles/clock.h"
#include "devices/roles/detection.h"

namespace focalstage {

namespace {

constexpr std::chrono::milliseconds tick{2};
constexpr double reopen_s = 1.0;

}  // namespace

Status ArucoTracker::start() {
  const std::lock_guard starting(starting_);
  if (thread_.joinable()) return {};
  Result<MarkerFinder> finder = MarkerFinder::make(settings_);
  if (!finder) return finder.fault();
  finder_.emplace(std::move(*finder));
  const Status opened = camera_->open();
  if (!opened && opened.fault().code != "camera.absent") return opened;
  {
    const std::lock_guard lock(mutex_);
    absent_ = opened ? std::nullopt : std::optional(opened.fault());
    started_ = true;
    frames_ = lost_pictures_ = 0;
    newest_.reset();
  }
  try {
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  } catch (const std::system_error& error) {
    return Fault{"aruco.thread", "aruco", std::string("no thread can be had: ") + error.what(), ""};
  }
  return {};
}

void ArucoTracker::stop() {
  const std::lock_guard starting(starting_);
  if (thread_.joinable()) {
    thread_.request_stop();
    thread_.join();
  }
  camera_->close();
  const std::lock_guard lock(mutex_);
  started_ = false;
  newest_.reset();
}

void ArucoTracker::run(const std::stop_token& stop) {
  std::shared_ptr<const CameraFrame> last;
  double reopened_s = monotonic_s();
  while (!stop.stop_requested()) {
    const auto frame = camera_->newest();
    if (frame && frame != last) {
      see(*frame);
      last = frame;
    } else if (camera_->state().phase != DevicePhase::running && monotonic_s() - reopened_s > reopen_s) {
      reopened_s = monotonic_s();
      const Status opened = camera_->open();
      const std::lock_guard lock(mutex_);
      absent_ = opened ? std::nullopt : std::optional(opened.fault());
    }
    std::this_thread::sleep_for(tick);
  }
}

void ArucoTracker::see(const CameraFrame& frame) {
  TrackedFrame seen;
  seen.number = static_cast<std::int64_t>(frame.number);
  seen.time_s = frame.time_s;
  seen.bodies = finder_->find(frame);
  seen.arrival_s = monotonic_s();
  seen.latency_s = seen.arrival_s - frame.time_s;
  const std::lock_guard lock(mutex_);
  if (newest_ && seen.number > newest_->number + 1) {
    lost_pictures_ += static_cast<std::uint64_t>(seen.number - newest_->number - 1);
  }
  newest_ = std::make_shared<const TrackedFrame>(std::move(seen));
  ++frames_;
}

std::shared_ptr<const TrackedFrame> ArucoTracker::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

TrackerState ArucoTracker::state() const {
  const DeviceState camera = camera_->state();
  const std::lock_guard lock(mutex_);
  TrackerState state;
  state.frames = frames_;
  state.late = lost_pictures_;
  if (!started_) return state;
  const double silence_s = detection_s(Doubt::tracker, 0.0);
  const bool fresh = newest_ && monotonic_s() - newest_->arrival_s <= silence_s;
  state.phase = fresh ? TrackerPhase::tracking : newest_ ? TrackerPhase::lost : TrackerPhase::seeking;
  if (fresh) return state;
  state.fault = camera.fault ? camera.fault : absent_;
  if (!state.fault && newest_) {
    state.fault =
        Fault{"tracker.lost", "camera", "no picture came", "see that the camera runs, at 20 pictures a second"};
  }
  return state;
}

}  // namespace focalstage
