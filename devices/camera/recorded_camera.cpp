#include "devices/camera/recorded_camera.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

namespace focalstage {

Status RecordedCamera::open() {
  const std::lock_guard lock(mutex_);
  if (opened_s_) return {};
  std::vector<std::string> paths;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(settings_.folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().extension() == ".pgm") paths.push_back(entry->path().string());
  }
  if (error || paths.empty()) {
    return Fault{"camera.folder", settings_.folder, error ? error.message() : "there is no picture in it",
                 "record *.pgm files into it"};
  }
  std::ranges::sort(paths);
  paths_ = std::move(paths);
  fault_.reset();
  newest_.reset();
  opened_s_ = settings_.now_s();
  return {};
}

void RecordedCamera::close() {
  const std::lock_guard lock(mutex_);
  opened_s_.reset();
  newest_.reset();
  fault_.reset();
}

std::optional<std::uint64_t> RecordedCamera::turn() const {
  const double passed_s = std::max(settings_.now_s() - *opened_s_, 0.0);
  const auto turn = static_cast<std::uint64_t>(std::floor(passed_s * settings_.rate_hz));
  if (!settings_.loop && turn >= paths_.size()) return std::nullopt;
  return turn;
}

void RecordedCamera::load(std::uint64_t turn) const {
  Result<GrayImage> image = read_pgm(paths_[turn % paths_.size()]);
  if (!image) {
    fault_ = image.fault();
    newest_.reset();
    return;
  }
  const double time_s = *opened_s_ + static_cast<double>(turn) / settings_.rate_hz;
  newest_ = std::make_shared<const CameraFrame>(
      CameraFrame{image->width_px, image->height_px, turn, time_s, std::move(image->gray)});
}

std::shared_ptr<const CameraFrame> RecordedCamera::newest() const {
  const std::lock_guard lock(mutex_);
  if (!opened_s_ || fault_) return nullptr;
  const auto now = turn();
  if (!now) {
    newest_.reset();
    fault_ = Fault{"camera.ended", settings_.folder, "the recording is at its end", "open it again, or loop it"};
  } else if (!newest_ || newest_->number != *now) {
    load(*now);
  }
  return newest_;
}

DeviceState RecordedCamera::state() const {
  (void)newest();
  const std::lock_guard lock(mutex_);
  DeviceState state;
  if (!opened_s_) return state;
  state.phase = fault_ ? DevicePhase::lost : DevicePhase::running;
  state.fault = fault_;
  if (newest_) state.heard_s = newest_->time_s;
  return state;
}

Status RecordedCamera::identify() {
  return Fault{"camera.identify", settings_.folder, "a recording cannot show itself", ""};
}

}  // namespace focalstage
