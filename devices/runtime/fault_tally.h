#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>

#include "devices/player/priority_mutex.h"

namespace focalstage {

/// How often each code of fault was met since the start. Any thread, also the one that keeps the rig's time.
class FaultTally {
 public:
  /// Codes come from this program alone, but a bound costs nothing: what is beyond it counts as "other".
  static constexpr std::size_t most_codes = 256;

  void count(const std::string& code) {
    const std::lock_guard lock(mutex_);
    const bool room = counts_.size() < most_codes || counts_.contains(code);
    ++counts_[room ? code : "other"];
  }

  std::map<std::string, std::uint64_t> counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
  }

 private:
  mutable PriorityMutex mutex_;
  std::map<std::string, std::uint64_t> counts_;
};

}  // namespace focalstage
