#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/optics/needs.h"

namespace focalstage {

/// A histogram whose sums over any range cost two look-ups.
class NeedSums {
 public:
  explicit NeedSums(const PowerHistogram& needs) : cells_(needs.cells()), weight_{0.0}, moment_{0.0} {
    for (const PowerHistogram::Cell& cell : cells_) {
      const auto weight = static_cast<double>(cell.weight);
      weight_.push_back(weight_.back() + weight);
      moment_.push_back(moment_.back() + weight * cell.power_d);
    }
  }

  std::size_t count() const { return cells_.size(); }
  double power_d(std::size_t i) const { return cells_[i].power_d; }

  /// Index of the first cell above `power_d`.
  std::size_t after(double power_d) const {
    const auto above = [](double limit_d, const PowerHistogram::Cell& cell) { return limit_d < cell.power_d; };
    return static_cast<std::size_t>(std::upper_bound(cells_.begin(), cells_.end(), power_d, above) - cells_.begin());
  }

  /// Sum of weight * distance to `power_d` over the cells [from, to), all on the named side of it.
  double from_below(std::size_t from, std::size_t to, double power_d) const {
    return std::max(0.0, (weight_[to] - weight_[from]) * power_d - (moment_[to] - moment_[from]));
  }
  double from_above(std::size_t from, std::size_t to, double power_d) const {
    return std::max(0.0, (moment_[to] - moment_[from]) - (weight_[to] - weight_[from]) * power_d);
  }

  /// The cells [from, to) between two powers, each to the nearer of the two.
  double between(std::size_t from, std::size_t to, double low_d, double high_d) const {
    const std::size_t middle = std::clamp(after((low_d + high_d) / 2.0), from, to);
    return from_above(from, middle, low_d) + from_below(middle, to, high_d);
  }

  /// The median of the cells [from, to): the first cell that half the weight does not lie beyond.
  std::size_t median(std::size_t from, std::size_t to) const {
    const double half = (weight_[from] + weight_[to]) / 2.0;
    const auto begin = weight_.begin() + static_cast<std::ptrdiff_t>(from) + 1;
    const auto end = weight_.begin() + static_cast<std::ptrdiff_t>(to);
    return from + static_cast<std::size_t>(std::lower_bound(begin, end, half) - begin);
  }

  /// What the cells [from, to) lose to their median.
  double cluster(std::size_t from, std::size_t to) const {
    if (from >= to) return 0.0;
    const std::size_t centre = median(from, to);
    return from_below(from, centre, power_d(centre)) + from_above(centre, to, power_d(centre));
  }

 private:
  std::vector<PowerHistogram::Cell> cells_;
  std::vector<double> weight_;  ///< of the cells before
  std::vector<double> moment_;  ///< weight * power, likewise
};

}  // namespace focalstage
