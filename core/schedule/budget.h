#pragma once

#include <cstdint>
#include <stop_token>

namespace focalstage {

/// How long a search may go on, in steps of about ten nanoseconds each: the same on every machine, and no clock needed.
class Budget {
 public:
  explicit Budget(std::uint64_t steps, std::stop_token stop = {}) : left_(steps), stop_(std::move(stop)) {}

  /// Takes `steps` away; false once there are none left or somebody asked to stop.
  bool spend(std::uint64_t steps) {
    left_ = steps < left_ ? left_ - steps : 0;
    return !spent();
  }
  bool spent() const { return left_ == 0 || stop_.stop_requested(); }
  bool stopped() const { return stop_.stop_requested(); }

 private:
  std::uint64_t left_;
  std::stop_token stop_;
};

}  // namespace focalstage
