#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

#include "devices/player/priority_mutex.h"
#include "focalstage/v1/rig.pb.h"

namespace focalstage {

/// Answers on their way to a live client: put in by any thread, also the rig's, taken out by the one that writes.
class LiveOutbox {
 public:
  void put(v1::LiveReply reply) {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    replies_.push_back(std::move(reply));
    changed_.notify_all();
  }

  /// The next one, or nothing by `until` or once closed.
  std::optional<v1::LiveReply> next(std::chrono::steady_clock::time_point until) {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, until, [&] { return closed_ || !replies_.empty(); });
    if (closed_ || replies_.empty()) return std::nullopt;
    v1::LiveReply reply = std::move(replies_.front());
    replies_.pop_front();
    return reply;
  }

  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

  bool closed() const {
    const std::lock_guard lock(mutex_);
    return closed_;
  }

 private:
  mutable PriorityMutex mutex_;
  std::condition_variable_any changed_;
  std::deque<v1::LiveReply> replies_;
  bool closed_ = false;
};

}  // namespace focalstage
