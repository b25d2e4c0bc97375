#include "devices/camera/v4l2_camera.h"

#include <system_error>
#include <utility>

#include "devices/roles/clock.h"

namespace focalstage {

namespace {

constexpr int addresses = 64;
constexpr int wait_ms = 20;
constexpr double longest_silence_s = 1.0;

std::string address_of(int number) { return "/dev/video" + std::to_string(number); }

}  // namespace

std::vector<DeviceId> probe_v4l2(V4l2Calls& calls) {
  std::vector<DeviceId> found;
  for (int n = 0; n < addresses; ++n) {
    const auto camera = describe_v4l2(calls, address_of(n));
    if (camera) found.push_back({"camera", camera->model, camera->bus, camera->address});
  }
  return found;
}

V4l2Camera::V4l2Camera(V4l2Settings settings, std::shared_ptr<V4l2Calls> calls)
    : settings_(std::move(settings)), calls_(std::move(calls)) {}

Result<V4l2Description> V4l2Camera::find() const {
  const auto fits = [&](const std::optional<V4l2Description>& camera) {
    return camera && (settings_.bus.empty() || camera->bus == settings_.bus);
  };
  if (const auto camera = describe_v4l2(*calls_, settings_.address); fits(camera)) return *camera;
  for (int n = 0; n < addresses && !settings_.bus.empty(); ++n) {
    if (const auto camera = describe_v4l2(*calls_, address_of(n)); fits(camera)) return *camera;
  }
  return Fault{"camera.absent", settings_.bus.empty() ? settings_.address : settings_.bus, "there is no camera",
               "see that it is plugged in, and that you may open it"};
}

Status V4l2Camera::open() {
  const std::lock_guard opening(opening_);
  {
    const std::lock_guard lock(mutex_);
    if (state_.phase == DevicePhase::running) return {};
  }
  if (thread_.joinable()) thread_.join();  // it was lost: the thread has ended, or is about to
  stream_.reset();
  const auto found = find();
  if (!found) return found.fault();
  auto stream = V4l2Stream::open(calls_, settings_, found->address);
  if (!stream) return stream.fault();
  stream_ = std::move(*stream);
  {
    const std::lock_guard lock(mutex_);
    found_ = *found;
    newest_.reset();
    state_ = {};
    state_.phase = DevicePhase::running;
    state_.heard_s = monotonic_s();
  }
  try {
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  } catch (const std::system_error& error) {
    stream_.reset();
    const std::lock_guard lock(mutex_);
    state_ = {};
    return Fault{"camera.thread", found->address, std::string("no thread can be had: ") + error.what(), ""};
  }
  return {};
}

void V4l2Camera::close() {
  const std::lock_guard opening(opening_);
  if (thread_.joinable()) {
    thread_.request_stop();
    thread_.join();
  }
  stream_.reset();
  const std::lock_guard lock(mutex_);
  state_ = {};
  newest_.reset();
}

void V4l2Camera::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    auto picture = stream_->next(wait_ms, monotonic_s());
    const double now_s = monotonic_s();
    const std::lock_guard lock(mutex_);
    std::optional<Fault> fault;
    if (!picture) {
      fault = picture.fault();
    } else if (*picture) {
      newest_ = std::move(*picture);
      state_.heard_s = now_s;
    } else if (now_s - state_.heard_s > longest_silence_s) {
      fault = Fault{"camera.silent", found_.address, "no picture came for a second", "unplug it and plug it in again"};
    }
    if (!fault) continue;
    state_.phase = DevicePhase::lost;
    state_.fault = std::move(fault);
    newest_.reset();
    return;
  }
}

DeviceId V4l2Camera::id() const {
  const std::lock_guard lock(mutex_);
  const bool known = !found_.address.empty();
  return {"camera", found_.model, known ? found_.bus : settings_.bus, known ? found_.address : settings_.address};
}

DeviceState V4l2Camera::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

Status V4l2Camera::identify() {
  return Fault{"camera.identify", settings_.address, "a camera has nothing to show",
               "cover its lens and see whose picture darkens"};
}

std::shared_ptr<const CameraFrame> V4l2Camera::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

}  // namespace focalstage
