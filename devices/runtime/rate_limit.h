#pragma once

#include <algorithm>
#include <chrono>
#include <mutex>

namespace focalstage {

/// So much a second over time, and `burst` at once at most. Any thread.
class RateLimit {
 public:
  using Clock = std::chrono::steady_clock;

  RateLimit(double per_s, double burst) : per_s_(per_s), burst_(burst), left_(burst) {}

  /// False, and nothing taken, where less than `amount` is left.
  bool take(double amount = 1.0, Clock::time_point now = Clock::now()) {
    const std::lock_guard lock(mutex_);
    refill(now);
    if (left_ < amount) return false;
    left_ -= amount;
    return true;
  }

  /// Takes it in any case, and says how long to wait before it is paid for.
  Clock::duration owe(double amount, Clock::time_point now = Clock::now()) {
    const std::lock_guard lock(mutex_);
    refill(now);
    left_ -= amount;
    if (left_ >= 0.0) return {};
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(-left_ / per_s_));
  }

 private:
  void refill(Clock::time_point now) {
    if (now > filled_) left_ = std::min(burst_, left_ + per_s_ * std::chrono::duration<double>(now - filled_).count());
    filled_ = std::max(filled_, now);
  }

  std::mutex mutex_;
  double per_s_;
  double burst_;
  double left_;
  Clock::time_point filled_{};
};

}  // namespace focalstage
