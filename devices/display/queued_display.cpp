#include "devices/display/queued_display.h"

#include <utility>

namespace focalstage {

Status QueuedDisplay::open() {
  const std::lock_guard lock(opening_);
  if (thread_.joinable() && !queue_.report().fault) return {};
  end();
  Result<std::jthread> thread = take();
  if (!thread) return thread.fault();
  thread_ = *std::move(thread);
  return {};
}

void QueuedDisplay::close() {
  const std::lock_guard lock(opening_);
  end();
}

void QueuedDisplay::end() {
  queue_.close();
  thread_ = {};
  give_back();
}

}  // namespace focalstage
