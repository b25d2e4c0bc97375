#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/optics/needs.h"
#include "core/schedule/budget.h"

namespace focalstage {

// Where slices should lie: the k-median problem on a line, in dioptres. What a picture loses is |needed - nearest
// slice|, averaged over its solid angle; the best k powers lie at needed ones, and the needs that one power serves are
// neighbours, so that dynamic programming over the rising powers finds the optimum.

/// The mean of |needed - nearest power|; 0 where nothing is needed. `powers_d` in any order, one at least.
double mean_error_d(const PowerHistogram& needs, const std::vector<double>& powers_d);

/// The largest of it.
double worst_error_d(const PowerHistogram& needs, const std::vector<double>& powers_d);

/// The `count` powers, rising, with the least mean error: exact, in O(count n log^2 n) for n needed powers. Fewer where
/// fewer powers are needed at all; empty for no count.
std::vector<double> k_medians(const PowerHistogram& needs, int count);

/// `count` powers at even steps from the lowest need to the highest; the middle for one.
std::vector<double> uniform_powers(const PowerHistogram& needs, int count);

/// Nobody has a projector for more slices.
inline constexpr int most_powers = 64;

/// Which powers may be chosen, and which may follow each other. Indices are into `candidates_d`.
struct PlacementRules {
  std::vector<double> candidates_d;  ///< strictly rising
  double widest_gap_d = 0.0;         ///< two neighbours lie no farther apart
  std::function<bool(std::size_t)> first;
  std::function<bool(std::size_t)> last;
  std::function<bool(std::size_t, std::size_t)> next;
};

/// The powers of least mean error that keep the rules: `count` of them, or as few as there can be, 64 at most. Nothing
/// where there are none, or where the budget ran out.
std::optional<std::vector<double>> place_powers(const PowerHistogram& needs, const PlacementRules& rules,
                                                std::optional<int> count, Budget& budget);

}  // namespace focalstage
