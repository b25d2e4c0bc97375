#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "core/base/result.h"

namespace focalstage {

/// One editor holds the rig at a time. A lease ends when it is given back, or when its holder was not heard of for a
/// while: a client that vanished keeps nobody out for long.
class LeaseDesk {
 public:
  using Clock = std::chrono::steady_clock;

  explicit LeaseDesk(std::chrono::milliseconds lasts) : lasts_(lasts) {}

  /// The token of a new lease; "rig.held" names who has it.
  Result<std::string> acquire(const std::string& holder, Clock::time_point now = Clock::now());

  /// Prolongs the lease. "rig.lease" where the token is not that of the lease in force.
  Status use(const std::string& token, Clock::time_point now = Clock::now());

  void release(const std::string& token);

  /// Who holds the rig; empty when nobody does.
  std::string holder(Clock::time_point now = Clock::now()) const;

  std::chrono::milliseconds lasts() const { return lasts_; }

 private:
  bool held(Clock::time_point now) const { return !token_.empty() && now < until_; }

  std::chrono::milliseconds lasts_;
  mutable std::mutex mutex_;
  std::string token_;
  std::string holder_;
  Clock::time_point until_{};
};

}  // namespace focalstage
