#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace focalstage {

/// The numbers 0 to count - 1, each a set of its own until joined; the smallest member stands for its set.
class JoinedSets {
 public:
  explicit JoinedSets(std::size_t count) : up_(count) { std::iota(up_.begin(), up_.end(), 0U); }

  std::uint32_t root(std::uint32_t member) {
    while (up_[member] != member) member = up_[member] = up_[up_[member]];
    return member;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    up_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> up_;
};

}  // namespace focalstage
