#include <algorithm>
#include <cmath>
#include <limits>

#include "core/schedule/need_sums.h"
#include "core/schedule/place_powers.h"

namespace focalstage {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// One more cluster: best[j] becomes the least loss of the first j cells in one cluster more than before. The best
/// start of the last cluster never falls as j rises (the loss is a Monge array), which divides the search.
class ClusterLayer {
 public:
  ClusterLayer(const NeedSums& sums, const std::vector<double>& before)
      : best(before.size(), infinity), start(before.size(), 0), sums_(sums), before_(before) {
    fill(1, before.size() - 1, 0, before.size() - 1);
  }

  std::vector<double> best;
  std::vector<std::size_t> start;  ///< of the last cluster

 private:
  void fill(std::size_t first, std::size_t last, std::size_t low, std::size_t high) {
    if (first > last) return;
    const std::size_t middle = (first + last) / 2;
    for (std::size_t i = low; i <= std::min(high, middle - 1); ++i) {
      const double loss = before_[i] + sums_.cluster(i, middle);
      if (loss < best[middle]) {
        best[middle] = loss;
        start[middle] = i;
      }
    }
    if (middle > first) fill(first, middle - 1, low, start[middle]);
    fill(middle + 1, last, start[middle], high);
  }

  const NeedSums& sums_;
  const std::vector<double>& before_;
};

double nearest_error_d(double power_d, const std::vector<double>& powers_d) {
  double nearest_d = infinity;
  for (const double own_d : powers_d) nearest_d = std::min(nearest_d, std::abs(own_d - power_d));
  return nearest_d;
}

}  // namespace

double mean_error_d(const PowerHistogram& needs, const std::vector<double>& powers_d) {
  double sum = 0.0;
  double weight = 0.0;
  for (const PowerHistogram::Cell& cell : needs.cells()) {
    sum += static_cast<double>(cell.weight) * nearest_error_d(cell.power_d, powers_d);
    weight += static_cast<double>(cell.weight);
  }
  return weight > 0.0 ? sum / weight : 0.0;
}

double worst_error_d(const PowerHistogram& needs, const std::vector<double>& powers_d) {
  double worst_d = 0.0;
  for (const PowerHistogram::Cell& cell : needs.cells()) {
    worst_d = std::max(worst_d, nearest_error_d(cell.power_d, powers_d));
  }
  return worst_d;
}

std::vector<double> k_medians(const PowerHistogram& needs, int count) {
  const NeedSums sums(needs);
  if (sums.count() == 0 || count < 1) return {};
  const std::size_t clusters = std::min(static_cast<std::size_t>(count), sums.count());
  std::vector<double> best(sums.count() + 1, infinity);
  best[0] = 0.0;
  std::vector<std::vector<std::size_t>> starts;
  for (std::size_t k = 0; k < clusters; ++k) {
    ClusterLayer layer(sums, best);
    best = std::move(layer.best);
    starts.push_back(std::move(layer.start));
  }
  std::vector<double> powers_d;
  std::size_t end = sums.count();
  for (std::size_t k = clusters; k-- > 0;) {
    const std::size_t start = starts[k][end];
    powers_d.push_back(sums.power_d(sums.median(start, end)));
    end = start;
  }
  std::reverse(powers_d.begin(), powers_d.end());
  return powers_d;
}

std::vector<double> uniform_powers(const PowerHistogram& needs, int count) {
  const double low_d = needs.lowest_d();
  const double high_d = needs.highest_d();
  if (count == 1) return {(low_d + high_d) / 2.0};
  std::vector<double> powers_d;
  for (int n = 0; n < count; ++n) powers_d.push_back(std::lerp(low_d, high_d, n / (count - 1.0)));
  return powers_d;
}

}  // namespace focalstage
