#include "editor/pipeline/frame_queue.h"

#include <utility>

namespace focalstage {
namespace {

constexpr std::size_t capacity = 3;

}  // namespace

FrameQueue::FrameQueue(ShowWriter& writer) : writer_(writer), thread_([this] { run(); }) {}

FrameQueue::~FrameQueue() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    items_.clear();
  }
  changed_.notify_all();
  thread_.join();
}

Status FrameQueue::add(int frame, std::shared_ptr<const FrameImages> images, const FrameMeasure& measure,
                       std::size_t projector) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return fault_ || items_.size() < capacity; });
  if (fault_) return *fault_;
  items_.push_back({frame, std::move(images), measure, projector});
  changed_.notify_all();
  return {};
}

Status FrameQueue::drain() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return fault_ || (items_.empty() && !writing_); });
  if (fault_) return *fault_;
  return {};
}

void FrameQueue::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return closed_ || !items_.empty(); });
    if (items_.empty()) return;
    const Item item = std::move(items_.front());
    items_.pop_front();
    writing_ = true;
    lock.unlock();
    const Status written = writer_.add_frame(item.frame, *item.images, item.measure, item.projector);
    lock.lock();
    writing_ = false;
    if (!written && !fault_) {
      fault_ = written.fault();
      items_.clear();
    }
    changed_.notify_all();
    if (fault_) return;
  }
}

}  // namespace focalstage
