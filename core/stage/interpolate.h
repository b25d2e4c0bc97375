#pragma once

#include <cstddef>
#include <vector>

#include <glm/gtc/quaternion.hpp>

namespace focalstage {

/// Between two unit rotations along the shorter arc, at constant speed; `share` 0 gives `a`. Made without the C
/// library's circle (core/mesh/circle.h), since poses are stored to the last bit.
glm::dquat slerp(const glm::dquat& a, const glm::dquat& b, double share);

/// Where a moment lies among ascending times: between `from` and `to`, `share` of the way. Before the first and after
/// the last both are that one. `count` must not be 0.
struct Between {
  std::size_t from = 0;
  std::size_t to = 0;
  double share = 0.0;
};

template <class TimeAt>
Between between(std::size_t count, double time_s, TimeAt&& time_at) {
  std::size_t later = 0;  // the first whose time is after the moment
  for (std::size_t low = 0, high = count; low < high; later = low) {
    const std::size_t middle = low + (high - low) / 2;
    if (time_at(middle) <= time_s) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  if (later == 0) return {0, 0, 0.0};
  if (later == count) return {count - 1, count - 1, 0.0};
  const double start_s = time_at(later - 1);
  return {later - 1, later, (time_s - start_s) / (time_at(later) - start_s)};
}

}  // namespace focalstage
