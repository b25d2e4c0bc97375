#include "core/schedule/place_powers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace focalstage {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double tolerance_d = 1e-9;

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

  /// The cells above `low_d` up to `high_d`, each to the nearer of the two.
  double between(double low_d, double high_d) const {
    const std::size_t from = after(low_d), to = after(high_d), middle = after((low_d + high_d) / 2.0);
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

/// The best way to a candidate: by how many powers, at which loss, from where.
struct Way {
  int powers = 0;  ///< 0: none
  double loss = infinity;
  std::size_t from = 0;

  bool better_than(const Way& other) const {
    if (powers == 0 || other.powers == 0) return powers > other.powers;
    return powers != other.powers ? powers < other.powers : loss < other.loss;
  }
};

/// Searches the candidates from low to high.
class Placer {
 public:
  Placer(const PowerHistogram& needs, const PlacementRules& rules, Budget& budget)
      : sums_(needs), rules_(rules), budget_(budget) {}

  std::optional<std::vector<double>> fewest() {
    std::vector<Way> ways = starts();
    for (std::size_t j = 0; j < ways.size(); ++j) {
      if (!extend(
              j, [&](std::size_t i) { return ways[i]; }, ways[j]))
        return std::nullopt;
    }
    Way best;
    const std::optional<std::size_t> end = end_of(ways, best);
    if (!end) return std::nullopt;
    std::vector<double> powers_d{power_d(*end)};
    for (std::size_t at = *end; ways[at].powers > 1; powers_d.push_back(power_d(at))) at = ways[at].from;
    std::reverse(powers_d.begin(), powers_d.end());
    return powers_d;
  }

  std::optional<std::vector<double>> exactly(int count) {
    std::vector<std::vector<Way>> layers{starts()};
    for (int n = 2; n <= count; ++n) {
      std::vector<Way> layer(layers.back().size());
      for (std::size_t j = 0; j < layer.size(); ++j) {
        if (!extend(
                j, [&](std::size_t i) { return layers.back()[i]; }, layer[j]))
          return std::nullopt;
      }
      layers.push_back(std::move(layer));
    }
    Way best;
    std::optional<std::size_t> end = end_of(layers.back(), best);
    if (!end) return std::nullopt;
    std::vector<double> powers_d;
    std::size_t at = *end;
    for (std::size_t n = layers.size(); n-- > 0; at = layers[n].at(at).from) powers_d.push_back(power_d(at));
    std::reverse(powers_d.begin(), powers_d.end());
    return powers_d;
  }

 private:
  double power_d(std::size_t i) const { return rules_.candidates_d[i]; }

  std::vector<Way> starts() const {
    std::vector<Way> ways(rules_.candidates_d.size());
    for (std::size_t j = 0; j < ways.size(); ++j) {
      if (rules_.first(j)) ways[j] = {1, sums_.from_below(0, sums_.after(power_d(j)), power_d(j)), j};
    }
    return ways;
  }

  /// Ways that end in `j`, from the candidates below that are near enough; false when the budget is spent.
  template <class WayTo>
  bool extend(std::size_t j, const WayTo& way_to, Way& best) {
    const auto begin = rules_.candidates_d.begin();
    const double lowest_d = power_d(j) - rules_.widest_gap_d - tolerance_d;
    const auto first =
        static_cast<std::size_t>(std::lower_bound(begin, begin + static_cast<std::ptrdiff_t>(j), lowest_d) - begin);
    for (std::size_t i = first; i < j; ++i) {
      const Way before = way_to(i);
      if (before.powers == 0) continue;
      const Way way{before.powers + 1, before.loss + sums_.between(power_d(i), power_d(j)), i};
      if (way.better_than(best) && rules_.next(i, j)) best = way;
    }
    return budget_.spend(1 + (j - first) * 20);
  }

  std::optional<std::size_t> end_of(const std::vector<Way>& ways, Way& best) const {
    std::optional<std::size_t> end;
    for (std::size_t j = 0; j < ways.size(); ++j) {
      if (ways[j].powers == 0 || !rules_.last(j)) continue;
      Way way = ways[j];
      way.loss += sums_.from_above(sums_.after(power_d(j)), sums_.count(), power_d(j));
      if (!way.better_than(best)) continue;
      best = way;
      end = j;
    }
    return end;
  }

  NeedSums sums_;
  const PlacementRules& rules_;
  Budget& budget_;
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

std::optional<std::vector<double>> place_powers(const PowerHistogram& needs, const PlacementRules& rules,
                                                std::optional<int> count, Budget& budget) {
  Placer placer(needs, rules, budget);
  if (!count) return placer.fewest();
  if (*count < 1 || static_cast<std::size_t>(*count) > rules.candidates_d.size()) return std::nullopt;
  return placer.exactly(*count);
}

}  // namespace focalstage
