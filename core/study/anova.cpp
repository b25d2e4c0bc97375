#include "core/study/anova.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/distributions.h"

namespace focalstage {
namespace {

using Columns = std::vector<std::vector<double>>;

/// Columns that are 1 where `is(mean, level)`, for levels 1 to count - 1: level 0 is what they are told against.
template <class Is>
Columns levels(const CellMeans& cells, int count, Is is) {
  Columns columns;
  for (int level = 1; level < count; ++level) {
    std::vector<double> column;
    for (const CellMean& mean : cells.means) column.push_back(is(mean, level) ? 1.0 : 0.0);
    columns.push_back(std::move(column));
  }
  return columns;
}

Columns products(const Columns& a, const Columns& b) {
  Columns columns;
  for (const auto& left : a) {
    for (const auto& right : b) {
      std::vector<double> column(left.size());
      std::ranges::transform(left, right, column.begin(), std::multiplies<>());
      columns.push_back(std::move(column));
    }
  }
  return columns;
}

Columns joined(std::initializer_list<const Columns*> parts) {
  Columns all;
  for (const Columns* part : parts) all.insert(all.end(), part->begin(), part->end());
  return all;
}

/// Mean error and how many means, per condition and target.
struct CellSum {
  double mean_m = 0.0;
  double count = 0.0;
};

std::vector<CellSum> cell_sums(const Study& study, const CellMeans& cells, int condition) {
  std::vector<CellSum> sums(study.targets.size());
  for (const CellMean& mean : cells.means) {
    if (mean.condition != condition) continue;
    CellSum& sum = sums[static_cast<std::size_t>(mean.target)];
    sum.mean_m += mean.error_m();
    sum.count += 1.0;
  }
  for (CellSum& sum : sums) sum.mean_m /= sum.count;
  return sums;
}

PairTest pair_test(const Study& study, const CellMeans& cells, int first, int second, double variance, double df) {
  const auto a = cell_sums(study, cells, first);
  const auto b = cell_sums(study, cells, second);
  const double targets = static_cast<double>(a.size());
  PairTest test{first, second, 0.0, 0.0, df, 1.0};
  double spread = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    test.difference_m += (a[k].mean_m - b[k].mean_m) / targets;
    spread += (1.0 / a[k].count + 1.0 / b[k].count) / (targets * targets);
  }
  test.t = test.difference_m / std::sqrt(variance * spread);
  test.p = t_two_sided(test.t, df);
  return test;
}

/// Holm (1979): the smallest p times the number of tests, the next one times one less, never falling.
void adjust(std::vector<PairTest>& tests) {
  std::vector<std::size_t> order(tests.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t k) { return tests[k].p; });
  double least = 0.0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    PairTest& test = tests[order[rank]];
    least = std::max(least, std::min(1.0, test.p * static_cast<double>(order.size() - rank)));
    test.p = least;
  }
}

}  // namespace

std::optional<Anova> anova_of(const Study& study, const CellMeans& cells) {
  const int conditions = static_cast<int>(study.conditions.size());
  const Columns level{std::vector<double>(cells.means.size(), 1.0)};
  const Columns a = levels(cells, conditions, [](const CellMean& m, int k) { return m.condition == k; });
  const Columns b =
      levels(cells, static_cast<int>(study.targets.size()), [](const CellMean& m, int k) { return m.target == k; });
  const Columns ab = products(a, b);
  std::vector<double> errors;
  for (const CellMean& mean : cells.means) errors.push_back(mean.error_m());

  const auto only_a = least_squares(joined({&level, &a}), errors);
  const auto only_b = least_squares(joined({&level, &b}), errors);
  const auto both = least_squares(joined({&level, &a, &b}), errors);
  const auto all = least_squares(joined({&level, &a, &b, &ab}), errors);
  if (!only_a || !only_b || !both || !all || all->residual_df < 1.0) return std::nullopt;

  Anova anova;
  anova.condition = f_test(*only_b, *both, *all);
  anova.target = f_test(*only_a, *both, *all);
  anova.interaction = f_test(*both, *all, *all);
  anova.residual_ss = all->residual_ss;
  anova.residual_df = all->residual_df;
  if (!anova.condition) return anova;  // no residual: nothing to compare by
  const double variance = all->residual_ss / all->residual_df;
  for (int first = 0; first < conditions; ++first) {
    for (int second = first + 1; second < conditions; ++second) {
      anova.pairs.push_back(pair_test(study, cells, first, second, variance, all->residual_df));
    }
  }
  adjust(anova.pairs);
  return anova;
}

}  // namespace focalstage
