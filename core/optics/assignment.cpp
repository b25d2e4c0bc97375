#include "core/optics/assignment.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace focalstage {

SliceRule::SliceRule(const std::vector<double>& powers_d, Assignment assignment)
    : assignment_(assignment), bands_(powers_d.size()) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> order(powers_d.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return powers_d[a] < powers_d[b]; });

  for (std::size_t n = 0; n < powers_d.size(); ++n) bands_[n] = {infinity, powers_d[n], -infinity, true};
  const auto repeats = [&](std::size_t a, std::size_t b) { return powers_d[a] == powers_d[b]; };
  order.erase(std::unique(order.begin(), order.end(), repeats), order.end());
  if (order.empty()) return;

  lowest_d_ = powers_d[order.front()];
  highest_d_ = powers_d[order.back()];
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double own_d = powers_d[order[i]];
    const double share = assignment == Assignment::nearest ? 0.5 : 1.0;  // a nearest band ends half-way
    const double below_d = i == 0 ? -infinity : own_d + (powers_d[order[i - 1]] - own_d) * share;
    const double above_d = i + 1 == order.size() ? infinity : own_d + (powers_d[order[i + 1]] - own_d) * share;
    bands_[order[i]] = {below_d, own_d, above_d, false};
  }
}

double SliceRule::weight(std::size_t n, double power_d) const {
  const Band& band = bands_[n];
  if (band.empty) return 0.0;
  if (assignment_ == Assignment::nearest) return power_d > band.from_d && power_d <= band.to_d ? 1.0 : 0.0;
  const double edge_d = power_d < band.power_d ? band.from_d : band.to_d;
  if (std::abs(edge_d) == std::numeric_limits<double>::infinity() || power_d == band.power_d) return 1.0;
  return std::max(0.0, 1.0 - (power_d - band.power_d) / (edge_d - band.power_d));
}

double SliceRule::beyond_d(double power_d) const { return std::max({0.0, lowest_d_ - power_d, power_d - highest_d_}); }

}  // namespace focalstage
