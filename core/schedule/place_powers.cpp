#include "core/schedule/place_powers.h"

#include <algorithm>
#include <limits>

#include "core/schedule/need_sums.h"

namespace focalstage {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double tolerance_d = 1e-9;

/// The best way to a candidate: by how many powers, at which loss, from where.
struct Way {
  int powers = 0;  ///< 0: none
  double loss = infinity;
  std::size_t from = 0;
  double unevenness = 0.0;  ///< sum of squared gaps: decides between ways that lose the same

  bool better_than(const Way& other) const {
    if (powers == 0 || other.powers == 0) return powers > other.powers;
    if (powers != other.powers) return powers < other.powers;
    return loss != other.loss ? loss < other.loss : unevenness < other.unevenness;
  }
};

/// Searches the candidates from low to high.
class Placer {
 public:
  Placer(const PowerHistogram& needs, const PlacementRules& rules, Budget& budget)
      : sums_(needs), rules_(rules), budget_(budget) {
    for (const double power_d : rules.candidates_d) after_.push_back(sums_.after(power_d));
  }

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
      if (rules_.first(j)) ways[j] = {1, sums_.from_below(0, after_[j], power_d(j)), j, 0.0};
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
      if (before.powers == 0 || before.powers >= most_powers) continue;
      const double gap_d = power_d(j) - power_d(i);
      const Way way{before.powers + 1, before.loss + sums_.between(after_[i], after_[j], power_d(i), power_d(j)), i,
                    before.unevenness + gap_d * gap_d};
      if (way.better_than(best) && rules_.next(i, j)) best = way;
    }
    return budget_.spend(1 + j - first);
  }

  std::optional<std::size_t> end_of(const std::vector<Way>& ways, Way& best) const {
    std::optional<std::size_t> end;
    for (std::size_t j = 0; j < ways.size(); ++j) {
      if (ways[j].powers == 0 || !rules_.last(j)) continue;
      Way way = ways[j];
      way.loss += sums_.from_above(after_[j], sums_.count(), power_d(j));
      if (!way.better_than(best)) continue;
      best = way;
      end = j;
    }
    return end;
  }

  NeedSums sums_;
  std::vector<std::size_t> after_;  ///< of each candidate: the first cell above it
  const PlacementRules& rules_;
  Budget& budget_;
};

}  // namespace

std::optional<std::vector<double>> place_powers(const PowerHistogram& needs, const PlacementRules& rules,
                                                std::optional<int> count, Budget& budget) {
  Placer placer(needs, rules, budget);
  if (!count) return placer.fewest();
  if (*count < 1 || static_cast<std::size_t>(*count) > rules.candidates_d.size()) return std::nullopt;
  return placer.exactly(*count);
}

}  // namespace focalstage
