#include "devices/runtime/live_tracking.h"

#include <chrono>
#include <utility>

#include "devices/roles/clock.h"
#include "devices/roles/detection.h"
#include "devices/runtime/lateness.h"

namespace focalstage {

namespace {

// How often the tracker is asked. Not longer than a frame of any: velocities are made of all of them.
constexpr std::chrono::milliseconds tick{2};

DevicePhase phase_of(TrackerPhase phase) {
  switch (phase) {
    case TrackerPhase::off:
    case TrackerPhase::seeking:
      return DevicePhase::off;
    case TrackerPhase::tracking:
      return DevicePhase::running;
    case TrackerPhase::lost:
      return DevicePhase::lost;
    case TrackerPhase::refused:
      return DevicePhase::refused;
  }
  return DevicePhase::off;
}

/// A tenth less than the time by which it must be noticed: a busy machine wakes the watch late.
double silence_allowed_s() { return 0.9 * detection_s(Doubt::tracker, 0.0); }

}  // namespace

LiveTracking::LiveTracking(TrackerSetup setup, double lead_s, std::function<void(const Fault&)> doubt)
    : setup_(std::move(setup)),
      doubt_(std::move(doubt)),
      delay_(std::make_shared<PoseDelay>(lead_s)),
      tracks_(setup_.motion) {}

LiveTracking::~LiveTracking() {
  if (thread_.joinable()) {
    thread_.request_stop();
    thread_.join();
  }
  setup_.tracker->stop();
}

Status LiveTracking::start() {
  if (Status started = setup_.tracker->start(); !started) return started;
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  return {};
}

void LiveTracking::run(const std::stop_token& stop) {
  prefer_this_thread();
  while (!stop.stop_requested()) {
    if (const auto doubt = step()) doubt_(*doubt);
    std::this_thread::sleep_for(tick);
  }
}

std::optional<Fault> LiveTracking::step() {
  const auto frame = setup_.tracker->newest();
  const std::lock_guard lock(mutex_);
  if (frame && frame != taken_) tracks_.take(*frame);
  taken_ = frame;
  if (watched_.empty()) return std::nullopt;
  return tracks_.doubt(watched_, setup_.tracker->state(), monotonic_s(), silence_allowed_s());
}

Result<PosedProject> LiveTracking::pose(const Project& project) const {
  const double now_s = monotonic_s();
  BodyPoses poses;
  std::optional<BodyTracks::Moment> moment;
  {
    const std::lock_guard lock(mutex_);
    poses = tracks_.at(now_s + delay_->lead_s());
    moment = tracks_.newest();
  }
  for (auto& [name, pose] : poses) {
    if (pose) pose = setup_.world_from_tracker * *pose;
  }
  Result<Project> posed = placed(project, poses, setup_.body_from_thing);
  if (!posed) return posed.fault();
  return PosedProject{std::make_shared<const Project>(std::move(*posed)), bodies_of(project),
                      moment ? moment->count : 0, moment ? moment->seen_s : now_s, now_s};
}

std::uint64_t LiveTracking::newest() const {
  const std::lock_guard lock(mutex_);
  return tracks_.newest() ? tracks_.newest()->count : 0;
}

RigPart LiveTracking::part() const {
  const TrackerState state = setup_.tracker->state();
  RigPart part{setup_.id, {}};
  part.state.phase = phase_of(state.phase);
  part.state.fault = state.fault;
  if (const auto frame = setup_.tracker->newest()) part.state.heard_s = frame->arrival_s;
  return part;
}

void LiveTracking::watch(std::set<std::string> bodies) {
  const std::lock_guard lock(mutex_);
  delay_->follow(!bodies.empty());
  watched_ = std::move(bodies);
}

}  // namespace focalstage
