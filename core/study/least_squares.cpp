#include "core/study/least_squares.h"

#include <algorithm>
#include <cmath>

#include "core/base/distributions.h"

namespace focalstage {
namespace {

using Column = std::vector<double>;

constexpr double dependent = 1e-10;  // of a column's length: the rest is rounding
constexpr double no_variation_m = 1e-9;

double dot_from(const Column& a, const Column& b, std::size_t first) {
  double sum = 0.0;
  for (std::size_t i = first; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// y -= 2 v (v.y) / (v.v), from row `first` on.
void reflect(const Column& v, double v_dot_v, std::size_t first, Column& y) {
  const double factor = 2.0 * dot_from(v, y, first) / v_dot_v;
  for (std::size_t i = first; i < y.size(); ++i) y[i] -= factor * v[i];
}

}  // namespace

std::optional<LeastSquares> least_squares(std::vector<Column> columns, Column y) {
  if (columns.size() > y.size()) return std::nullopt;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    Column& own = columns[k];
    const double whole = std::sqrt(dot_from(own, own, 0));
    const double rest = std::sqrt(dot_from(own, own, k));
    if (!(rest > dependent * whole)) return std::nullopt;
    const double diagonal = own[k] > 0.0 ? -rest : rest;
    Column v = own;
    v[k] -= diagonal;
    const double v_dot_v = dot_from(v, v, k);
    for (std::size_t j = k + 1; j < columns.size(); ++j) reflect(v, v_dot_v, k, columns[j]);
    reflect(v, v_dot_v, k, y);
    own[k] = diagonal;
  }
  LeastSquares fit;
  fit.coefficients.resize(columns.size());
  for (std::size_t k = columns.size(); k-- > 0;) {
    double rest = y[k];
    for (std::size_t j = k + 1; j < columns.size(); ++j) rest -= columns[j][k] * fit.coefficients[j];
    fit.coefficients[k] = rest / columns[k][k];
  }
  fit.residual_ss = dot_from(y, y, columns.size());
  fit.residual_df = static_cast<double>(y.size() - columns.size());
  return fit;
}

std::optional<FTest> f_test(const LeastSquares& reduced, const LeastSquares& full, const LeastSquares& error) {
  const double df1 = reduced.residual_df - full.residual_df;
  if (!(df1 > 0.0 && error.residual_df > 0.0)) return std::nullopt;
  const double variance = error.residual_ss / error.residual_df;
  if (!(variance > no_variation_m * no_variation_m)) return std::nullopt;
  FTest test;
  test.ss = std::max(0.0, reduced.residual_ss - full.residual_ss);
  test.df1 = df1;
  test.df2 = error.residual_df;
  test.f = test.ss / df1 / variance;
  test.p = f_upper_tail(test.f, test.df1, test.df2);
  return test;
}

}  // namespace focalstage
