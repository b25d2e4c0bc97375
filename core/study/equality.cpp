#include "core/study/equality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace focalstage {
namespace {

constexpr std::size_t point_count = 201;
constexpr std::size_t spread_count = 16;
constexpr double slips = 0.04;

double normal_below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// Sums over a distribution of the point.
struct Moments {
  double mass = 0.0;
  double first = 0.0;
  double second = 0.0;

  void add(double weight, double point) {
    mass += weight;
    first += weight * point;
    second += weight * point * point;
  }
  double variance() const { return mass > 0.0 ? second / mass - first * first / (mass * mass) : 0.0; }
};

}  // namespace

EqualitySearch::EqualitySearch(std::vector<double> levels) : levels_(std::move(levels)) {
  const double low = levels_.front();
  const double range = levels_.back() - low;
  for (std::size_t i = 0; i < point_count; ++i) {
    points_.push_back(low + range * static_cast<double>(i) / static_cast<double>(point_count - 1));
  }
  const double least = range / 300.0;
  const double growth = std::pow(100.0, 1.0 / static_cast<double>(spread_count - 1));
  for (std::size_t i = 0; i < spread_count; ++i) spreads_.push_back(least * std::pow(growth, static_cast<double>(i)));
  weight_.assign(cells(), 1.0 / static_cast<double>(cells()));
  above_.reserve(levels_.size() * cells());
  for (const double level : levels_) {
    for (const double spread : spreads_) {
      for (const double point : points_) {
        above_.push_back(slips / 2.0 + (1.0 - slips) * normal_below((level - point) / spread));
      }
    }
  }
}

std::size_t EqualitySearch::next() const {
  const std::size_t count = points_.size();
  std::vector<double> known(count, 0.0);
  for (std::size_t i = 0; i < cells(); ++i) known[i % count] += weight_[i];
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> above(count);
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    std::fill(above.begin(), above.end(), 0.0);
    for (std::size_t spread = 0; spread < spreads_.size(); ++spread) {
      const double* weight = &weight_[spread * count];
      const double* likely = &above_[level * cells() + spread * count];
      for (std::size_t i = 0; i < count; ++i) above[i] += weight[i] * likely[i];
    }
    Moments yes, no;
    for (std::size_t i = 0; i < count; ++i) {
      yes.add(above[i], points_[i]);
      no.add(known[i] - above[i], points_[i]);
    }
    const double expected = yes.mass * yes.variance() + no.mass * no.variance();
    if (expected < least) {
      least = expected;
      best = level;
    }
  }
  return best;
}

void EqualitySearch::take(std::size_t level, bool above) {
  double sum = 0.0;
  for (std::size_t i = 0; i < cells(); ++i) {
    const double likely = above_[level * cells() + i];
    weight_[i] *= above ? likely : 1.0 - likely;
    sum += weight_[i];
  }
  for (double& weight : weight_) weight /= sum;
  ++answers_;
}

EqualityEstimate EqualitySearch::estimate() const {
  Moments all;
  double log_spread = 0.0;
  for (std::size_t i = 0; i < cells(); ++i) {
    all.add(weight_[i], points_[i % points_.size()]);
    log_spread += weight_[i] * std::log(spreads_[i / points_.size()]);
  }
  EqualityEstimate estimate;
  estimate.value = all.first / all.mass;
  const double step = points_[1] - points_[0];
  estimate.uncertainty = std::sqrt(std::max(0.0, all.variance()) + step * step / 12.0);  // of the points, and between
  estimate.spread = std::exp(log_spread);
  estimate.answers = answers_;
  estimate.inside = estimate.value - 2.0 * estimate.uncertainty > levels_.front() &&
                    estimate.value + 2.0 * estimate.uncertainty < levels_.back();
  return estimate;
}

}  // namespace focalstage
