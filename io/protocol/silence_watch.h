#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace focalstage {

/// Calls `on_silence` once, from a thread of its own, when nothing was heard for `limit`.
class SilenceWatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// `at_start` runs first in that thread.
  SilenceWatch(Clock::duration limit, std::function<void()> on_silence, std::function<void()> at_start = {});

  void heard();

  /// Whether it has called.
  bool fell_silent() const;

 private:
  void wait(const std::stop_token& stop);

  Clock::duration limit_;
  std::function<void()> on_silence_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  Clock::time_point last_ = Clock::now();
  bool silent_ = false;
  std::jthread thread_;
};

}  // namespace focalstage
