#include "devices/player/frame_cache.h"

#include <algorithm>
#include <utility>

namespace focalstage {

FrameCache::FrameCache(std::unique_ptr<FrameSource> source, int frames, std::size_t bytes_per_frame,
                       std::size_t budget_bytes)
    : source_(std::move(source)), frames_(frames) {
  // Three at the least: the one shown, the next, and the one being read.
  const std::size_t affordable = budget_bytes / std::max<std::size_t>(bytes_per_frame, 1);
  kept_ =
      static_cast<int>(std::min<std::size_t>(std::max<std::size_t>(affordable, 3), static_cast<std::size_t>(frames)));
  reader_ = std::jthread([this](const std::stop_token& stop) { read_ahead(stop); });
}

Result<FrameCache::Frame> FrameCache::get(int frame) {
  const std::lock_guard lock(mutex_);
  wanted_ = frame;
  changed_.notify_all();
  if (const auto failed = failed_.find(frame); failed != failed_.end()) return failed->second;
  const auto ready = ready_.find(frame);
  return ready == ready_.end() ? Frame() : ready->second;
}

Result<FrameCache::Frame> FrameCache::wait_for(int frame) {
  std::unique_lock lock(mutex_);
  wanted_ = frame;
  changed_.notify_all();
  changed_.wait(lock, [&] { return ready_.contains(frame) || failed_.contains(frame); });
  if (const auto failed = failed_.find(frame); failed != failed_.end()) return failed->second;
  return ready_.at(frame);
}

bool FrameCache::prepare(int frame) {
  const std::lock_guard lock(mutex_);
  prepared_ = frame;
  changed_.notify_all();
  return ready_.contains(frame) || failed_.contains(frame);
}

int FrameCache::distance_ahead(int frame) const { return (frame - wanted_ + frames_) % frames_; }

std::optional<int> FrameCache::next_missing() const {
  const auto missing = [&](int frame) { return !ready_.contains(frame) && !failed_.contains(frame); };
  if (missing(wanted_)) return wanted_;
  if (prepared_ && missing(*prepared_)) return prepared_;
  for (int ahead = 1; ahead < kept_; ++ahead) {
    const int frame = (wanted_ + ahead) % frames_;
    if (missing(frame)) return frame;
  }
  return std::nullopt;
}

void FrameCache::forget_far_frames() {
  std::erase_if(ready_,
                [&](const auto& entry) { return distance_ahead(entry.first) >= kept_ && entry.first != prepared_; });
}

void FrameCache::read_ahead(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [&] { return next_missing().has_value(); })) {
    const int frame = *next_missing();
    forget_far_frames();
    lock.unlock();
    Result<FrameImages> images = source_->frame(frame);
    lock.lock();
    if (images) {
      ready_.emplace(frame, std::make_shared<const FrameImages>(std::move(*images)));
    } else {
      failed_.emplace(frame, images.fault());
    }
    changed_.notify_all();
  }
}

}  // namespace focalstage
