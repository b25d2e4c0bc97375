#include "core/schedule/linear_program.h"

#include <algorithm>
#include <cmath>

namespace focalstage {
namespace {

using Vector = std::vector<double>;

/// Below this, relative to the numbers of the program, a residual or a gap is none.
constexpr double converged = 1e-9;
/// The same for the prices' residual: as prices of slack rows vanish, rounding in the normal equations leaves this much
/// of it. It misses the least cost by so much times the distance to it.
constexpr double prices_converged = 1e-5;
/// What keeps the factor of the normal equations from breaking down where rows leave an unknown all but free.
constexpr double least_pivot = 1e-13;

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

double largest(const Vector& numbers) {
  double most = 0.0;
  for (const double number : numbers) most = std::max(most, std::abs(number));
  return most;
}

Vector times(const Rows& rows, const Vector& x) {
  Vector result(rows.count());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = dot(rows[i], x);
  return result;
}

/// `sum` += rows^T weights.
void add_transposed(const Rows& rows, const Vector& weights, Vector& sum) {
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const std::span<const double> row = rows[i];
    for (std::size_t j = 0; j < row.size(); ++j) sum[j] += weights[i] * row[j];
  }
}

/// A symmetric positive matrix as L L^T.
class Factor {
 public:
  Factor(Vector matrix, std::size_t size) : lower_(std::move(matrix)), size_(size) {
    double most = 0.0;
    for (std::size_t j = 0; j < size_; ++j) most = std::max(most, at(j, j));
    for (std::size_t j = 0; j < size_; ++j) {
      const std::span<const double> own(&at(j, 0), j);
      at(j, j) = std::sqrt(std::max(at(j, j) - dot(own, own), least_pivot * most + 1e-300));
      for (std::size_t i = j + 1; i < size_; ++i) {
        at(i, j) = (at(i, j) - dot({&at(i, 0), j}, own)) / at(j, j);
      }
    }
  }

  Vector solve(Vector right) const {
    for (std::size_t i = 0; i < size_; ++i) {
      right[i] = (right[i] - dot({&at(i, 0), i}, {right.data(), i})) / at(i, i);
    }
    for (std::size_t i = size_; i-- > 0;) {
      right[i] /= at(i, i);
      for (std::size_t j = 0; j < i; ++j) right[j] -= at(i, j) * right[i];
    }
    return right;
  }

 private:
  double& at(std::size_t i, std::size_t j) { return lower_[i * size_ + j]; }
  const double& at(std::size_t i, std::size_t j) const { return lower_[i * size_ + j]; }

  Vector lower_;
  std::size_t size_;
};

/// ridge + at_most^T diag(weights) at_most; its lower half is all that is read.
Vector normal_matrix(const LinearProgram& program, const Vector& weights) {
  const std::size_t size = program.cost.size();
  Vector matrix(size * size, 0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const std::span<const double> row = program.at_most[i];
    for (std::size_t j = 0; j < size; ++j) {
      const double scaled = weights[i] * row[j];
      if (scaled == 0.0) continue;
      for (std::size_t k = 0; k <= j; ++k) matrix[j * size + k] += scaled * row[k];
    }
  }
  for (std::size_t j = 0; j < size; ++j) matrix[j * size + j] += program.ridge[j];
  return matrix;
}

/// Solves (H E^T; E 0) (x y) = (a b), H by its factor, y through the complement E H^-1 E^T.
class Saddle {
 public:
  Saddle(const LinearProgram& program, const Vector& weights)
      : equal_(program.equal),
        inner_(normal_matrix(program, weights), program.cost.size()),
        columns_(columns_of(equal_, inner_)),
        outer_(complement(equal_, columns_), equal_.count()) {}

  void solve(const Vector& a, const Vector& b, Vector& x, Vector& y) const {
    x = inner_.solve(a);
    Vector rest = times(equal_, x);
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= b[i];
    y = outer_.solve(std::move(rest));
    for (std::size_t i = 0; i < y.size(); ++i) {
      for (std::size_t j = 0; j < x.size(); ++j) x[j] -= columns_[i][j] * y[i];
    }
  }

 private:
  static std::vector<Vector> columns_of(const Rows& equal, const Factor& inner) {
    std::vector<Vector> columns;
    for (std::size_t i = 0; i < equal.count(); ++i) columns.push_back(inner.solve({equal[i].begin(), equal[i].end()}));
    return columns;
  }
  static Vector complement(const Rows& equal, const std::vector<Vector>& columns) {
    Vector matrix(columns.size() * columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j) matrix[i * columns.size() + j] = dot(equal[i], columns[j]);
    }
    return matrix;
  }

  const Rows& equal_;
  Factor inner_;
  std::vector<Vector> columns_;  ///< H^-1 E^T
  Factor outer_;
};

/// An interior point: slack and price of every row are above zero.
struct Point {
  Vector x;
  Vector slack;
  Vector price;
  Vector equal_price;
};

struct Residuals {
  Vector cost;   ///< ridge x + cost + at_most^T price + equal^T equal_price
  Vector rows;   ///< at_most x + slack - most
  Vector equal;  ///< equal x - exactly
};

Residuals residuals_of(const LinearProgram& program, const Point& point) {
  Residuals result{program.cost, times(program.at_most, point.x), times(program.equal, point.x)};
  for (std::size_t j = 0; j < point.x.size(); ++j) result.cost[j] += program.ridge[j] * point.x[j];
  add_transposed(program.at_most, point.price, result.cost);
  add_transposed(program.equal, point.equal_price, result.cost);
  for (std::size_t i = 0; i < point.slack.size(); ++i) result.rows[i] += point.slack[i] - program.most[i];
  for (std::size_t i = 0; i < result.equal.size(); ++i) result.equal[i] -= program.exactly[i];
  return result;
}

/// Newton's step towards slack * price = `target` in every row.
Point step_towards(const LinearProgram& program, const Saddle& saddle, const Point& point, const Residuals& off,
                   const Vector& target) {
  const std::size_t rows = point.slack.size();
  Vector weighted(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    weighted[i] = (target[i] - point.slack[i] * point.price[i] + point.price[i] * off.rows[i]) / point.slack[i];
  }
  Vector right(point.x.size(), 0.0);
  add_transposed(program.at_most, weighted, right);
  for (std::size_t j = 0; j < right.size(); ++j) right[j] = -right[j] - off.cost[j];
  Vector wanted(off.equal.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = -off.equal[i];

  Point step;
  saddle.solve(right, wanted, step.x, step.equal_price);
  step.slack = times(program.at_most, step.x);
  step.price.resize(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    step.slack[i] = -step.slack[i] - off.rows[i];
    step.price[i] = (target[i] - point.slack[i] * point.price[i] - point.price[i] * step.slack[i]) / point.slack[i];
  }
  return step;
}

/// How far along `step` all of `numbers` stay above zero; at most 1.
double reach(const Vector& numbers, const Vector& step) {
  double most = 1.0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (step[i] < 0.0) most = std::min(most, -numbers[i] / step[i]);
  }
  return most;
}

/// One predictor-corrector step; returns false where it does not move any more.
bool improve(const LinearProgram& program, const Residuals& off, Point& point) {
  const std::size_t rows = point.slack.size();
  const double gap = dot(point.slack, point.price) / static_cast<double>(rows);
  Vector weights(rows);
  for (std::size_t i = 0; i < rows; ++i) weights[i] = point.price[i] / point.slack[i];
  const Saddle saddle(program, weights);

  const Point guess = step_towards(program, saddle, point, off, Vector(rows, 0.0));
  const double guess_share = std::min(reach(point.slack, guess.slack), reach(point.price, guess.price));
  double guess_gap = 0.0;
  for (std::size_t i = 0; i < rows; ++i) {
    guess_gap += (point.slack[i] + guess_share * guess.slack[i]) * (point.price[i] + guess_share * guess.price[i]);
  }
  const double centre = gap * std::pow(guess_gap / static_cast<double>(rows) / gap, 3.0);
  Vector target(rows);
  for (std::size_t i = 0; i < rows; ++i) target[i] = centre - guess.slack[i] * guess.price[i];

  const Point step = step_towards(program, saddle, point, off, target);
  const double share = 0.99 * std::min(reach(point.slack, step.slack), reach(point.price, step.price));
  if (!(share > 1e-10)) return false;
  for (Vector Point::*part : {&Point::x, &Point::slack, &Point::price, &Point::equal_price}) {
    for (std::size_t i = 0; i < (point.*part).size(); ++i) (point.*part)[i] += share * (step.*part)[i];
  }
  return true;
}

Point first_point(const LinearProgram& program) {
  Point point{Vector(program.cost.size(), 0.0), program.most, Vector(program.most.size(), 1.0),
              Vector(program.exactly.size(), 0.0)};
  for (double& slack : point.slack) slack = std::max(1.0, slack);
  return point;
}

}  // namespace

std::span<double> Rows::add() {
  numbers.resize(numbers.size() + width, 0.0);
  return {numbers.data() + numbers.size() - width, width};
}

std::optional<std::vector<double>> least_cost(const LinearProgram& program, int most_steps) {
  const double scale_rows = 1.0 + std::max(largest(program.most), largest(program.exactly));
  const double scale_cost = 1.0 + largest(program.cost);
  Point point = first_point(program);
  for (int step = 0; step < most_steps; ++step) {
    const Residuals off = residuals_of(program, point);
    const double gap = dot(point.slack, point.price) / static_cast<double>(point.slack.size());
    const double worst_row = std::max(largest(off.rows), largest(off.equal));
    if (!std::isfinite(gap) || !std::isfinite(worst_row)) return std::nullopt;
    const bool at_least_cost = largest(off.cost) <= prices_converged * scale_cost && gap <= converged * scale_cost;
    if (at_least_cost && worst_row <= converged * scale_rows) return point.x;
    if (!improve(program, off, point)) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace focalstage
