#pragma once

#include <cstdint>
#include <cstdlib>
#include <vector>

#include "core/compile/frame.h"

namespace focalstage::exact {

/// How two compiles of the same frame differ.
struct Difference {
  std::uint64_t bytes = 0;
  std::uint64_t off = 0;  ///< by more than one code
  int worst = 0;

  Difference& operator+=(const Difference& other) {
    bytes += other.bytes;
    off += other.off;
    worst = other.worst > worst ? other.worst : worst;
    return *this;
  }
};

inline Difference difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  Difference result;
  result.bytes = a.size();
  if (a.size() != b.size()) return {a.size(), a.size(), 255};
  for (std::size_t i = 0; i < a.size(); ++i) {
    const int gap = std::abs(int{a[i]} - int{b[i]});
    if (gap > 1) ++result.off;
    if (gap > result.worst) result.worst = gap;
  }
  return result;
}

}  // namespace focalstage::exact
