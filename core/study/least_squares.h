#pragma once

#include <optional>
#include <vector>

namespace focalstage {

/// y as a sum of columns, as near as squares can tell.
struct LeastSquares {
  std::vector<double> coefficients;  ///< one per column
  double residual_ss = 0.0;
  double residual_df = 0.0;  ///< rows less columns
};

/// By Householder's reflections. Nothing where there are fewer rows than columns, or where a column is, to rounding, a
/// sum of those before it.
std::optional<LeastSquares> least_squares(std::vector<std::vector<double>> columns, std::vector<double> y);

/// Whether the columns of `full` beyond those of `reduced` explain more than chance would.
struct FTest {
  double f = 0.0;
  double df1 = 0.0;
  double df2 = 0.0;
  double p = 1.0;
  double ss = 0.0;  ///< what they explain

  bool operator==(const FTest&) const = default;
};

/// F = ((rss_reduced - rss_full) / df1) / (rss_error / df2), with `error` the model whose residual is chance. Nothing
/// where that residual is none: less than a nanometre per answer (values in metres) is rounding.
std::optional<FTest> f_test(const LeastSquares& reduced, const LeastSquares& full, const LeastSquares& error);

}  // namespace focalstage
