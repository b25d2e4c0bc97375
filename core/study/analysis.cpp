#include "core/study/analysis.h"

#include <algorithm>
#include <cmath>

#include "core/base/distributions.h"

namespace focalstage {
namespace {

constexpr double no_variation_m = 1e-9;

Spread spread_of(const std::vector<double>& values_m) {
  Spread spread;
  spread.count = static_cast<int>(values_m.size());
  if (values_m.empty()) return spread;
  for (const double value : values_m) spread.mean_m += value;
  spread.mean_m /= static_cast<double>(values_m.size());
  double squares = 0.0;
  for (const double value : values_m) squares += (value - spread.mean_m) * (value - spread.mean_m);
  if (spread.count > 1) spread.deviation_m = std::sqrt(squares / static_cast<double>(spread.count - 1));
  return spread;
}

ErrorSummary summary_of(const CellMeans& cells, int condition, int target) {
  std::vector<double> estimated;
  std::vector<double> errors;
  for (const CellMean& mean : cells.means) {
    if (mean.condition != condition || (target >= 0 && mean.target != target)) continue;
    estimated.push_back(mean.estimated_m);
    errors.push_back(mean.error_m());
  }
  return {condition, target, spread_of(estimated), spread_of(errors)};
}

/// The mean over targets of a participant's errors under a condition; nothing where one is missing.
std::optional<double> mean_error(const Study& study, const CellMeans& cells, int participant, int condition) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const CellMean& mean : cells.means) {
    if (mean.participant != participant || mean.condition != condition) continue;
    sum += mean.error_m();
    ++count;
  }
  if (count != study.targets.size()) return std::nullopt;
  return sum / static_cast<double>(count);
}

std::optional<Within> within_of(const Study& study, const CellMeans& cells, int first, int second) {
  std::vector<double> differences;
  for (const int participant : cells.used) {
    const auto a = mean_error(study, cells, participant, first);
    const auto b = mean_error(study, cells, participant, second);
    if (a && b) differences.push_back(*a - *b);
  }
  const Spread spread = spread_of(differences);
  if (spread.count < 2 || spread.deviation_m < no_variation_m) return std::nullopt;
  Within within{first, second, spread.count, spread.mean_m};
  const double error_m = spread.deviation_m / std::sqrt(static_cast<double>(spread.count));
  within.df = spread.count - 1;
  within.t = spread.mean_m / error_m;
  within.p = t_two_sided(within.t, within.df);
  const double reach_m = t_quantile(0.975, within.df) * error_m;
  within.low_m = spread.mean_m - reach_m;
  within.high_m = spread.mean_m + reach_m;
  return within;
}

}  // namespace

StudyAnalysis analyse(const Study& study, const std::vector<Response>& responses) {
  StudyAnalysis analysis;
  analysis.cells = cells_of(study, responses);
  const int conditions = static_cast<int>(study.conditions.size());
  for (int condition = 0; condition < conditions; ++condition) {
    analysis.by_condition.push_back(summary_of(analysis.cells, condition, -1));
    for (int target = 0; target < static_cast<int>(study.targets.size()); ++target) {
      analysis.by_target.push_back(summary_of(analysis.cells, condition, target));
    }
    for (int second = condition + 1; second < conditions; ++second) {
      const auto within = within_of(study, analysis.cells, condition, second);
      if (within) analysis.within.push_back(*within);
    }
  }
  analysis.regression = regression_of(study, analysis.cells);
  analysis.anova = anova_of(study, analysis.cells);
  return analysis;
}

}  // namespace focalstage
