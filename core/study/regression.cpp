#include "core/study/regression.h"

#include <algorithm>

namespace focalstage {
namespace {

using Columns = std::vector<std::vector<double>>;

/// A column of what `value` says of each mean.
template <class ValueOf>
std::vector<double> column(const std::vector<CellMean>& means, ValueOf value) {
  std::vector<double> values;
  values.reserve(means.size());
  for (const CellMean& mean : means) values.push_back(value(mean));
  return values;
}

std::vector<CellMean> of_condition(const CellMeans& cells, int condition) {
  std::vector<CellMean> means;
  std::ranges::copy_if(cells.means, std::back_inserter(means),
                       [&](const CellMean& mean) { return mean.condition == condition; });
  return means;
}

double actual(const CellMean& mean) { return mean.actual_m; }
double estimated(const CellMean& mean) { return mean.estimated_m; }
double one(const CellMean&) { return 1.0; }

std::optional<FittedLine> line_of(const CellMeans& cells, int condition) {
  const std::vector<CellMean> means = of_condition(cells, condition);
  const auto level = least_squares({column(means, one)}, column(means, estimated));
  const auto fit = least_squares({column(means, one), column(means, actual)}, column(means, estimated));
  if (!level || !fit) return std::nullopt;
  const double r_squared = level->residual_ss > 0.0 ? 1.0 - fit->residual_ss / level->residual_ss : 1.0;
  return FittedLine{condition, fit->coefficients[1], fit->coefficients[0], r_squared, static_cast<int>(means.size())};
}

}  // namespace

std::optional<Regression> regression_of(const Study& study, const CellMeans& cells) {
  const int conditions = static_cast<int>(study.conditions.size());
  Regression regression;
  Columns levels;
  Columns slopes;
  for (int k = 0; k < conditions; ++k) {
    const auto line = line_of(cells, k);
    if (!line) return std::nullopt;
    regression.lines.push_back(*line);
    levels.push_back(column(cells.means, [&](const CellMean& m) { return m.condition == k ? 1.0 : 0.0; }));
    slopes.push_back(column(cells.means, [&](const CellMean& m) { return m.condition == k ? m.actual_m : 0.0; }));
  }
  const std::vector<double> y = column(cells.means, estimated);
  const std::vector<double> x = column(cells.means, actual);

  Columns apart = levels;
  apart.insert(apart.end(), slopes.begin(), slopes.end());
  Columns parallel = levels;
  parallel.push_back(x);
  const auto apart_fit = least_squares(apart, y);
  const auto parallel_fit = least_squares(parallel, y);
  const auto one_fit = least_squares({column(cells.means, one), x}, y);
  if (!apart_fit || !parallel_fit || !one_fit) return std::nullopt;
  regression.common_slope = parallel_fit->coefficients.back();
  regression.parallel_m.assign(parallel_fit->coefficients.begin(), parallel_fit->coefficients.end() - 1);
  regression.slopes = f_test(*parallel_fit, *apart_fit, *apart_fit);
  regression.intercepts = f_test(*one_fit, *parallel_fit, *parallel_fit);
  return regression;
}

}  // namespace focalstage
