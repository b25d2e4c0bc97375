#include "core/rig_measure/lens_fit.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include <Eigen/Dense>

#include "core/base/number_words.h"
#include "core/rig_measure/passages.h"

namespace focalstage {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double degrees = 180.0 / std::numbers::pi;
// A line's light must move by this share of full light.
constexpr double least_height = 0.03;
// And, where it is as sharp as the others, by this share of the highest of them.
constexpr double least_of_best = 0.25;
// A crossing is never taken for better than that.
constexpr double least_spread_d = 2e-4;
// Near a turn of the sweep it is not clear which way a power is passed: of the greatest speed.
constexpr double least_speed = 0.2;
// Crossings that no lens explains together with the others, and how far off they all may be.
constexpr double outlier = 6.0;
constexpr double most_residual_d = 0.05;

struct Seen {
  std::size_t drive = 0;
  std::size_t target = 0;
  Crossing crossing;
};

/// rest, H[0], then real and imaginary part of H[1].., then a width per target.
struct Unknowns {
  int harmonics = 0;
  std::size_t targets = 0;

  Index count() const { return 2 + 2 * harmonics + static_cast<Index>(targets); }
  Index width(std::size_t target) const { return 2 + 2 * harmonics + static_cast<Index>(target); }
};

/// What the unknowns are multiplied by to give the power at a moment; without the widths.
VectorXd power_row(const Unknowns& unknowns, const DriveTones& drive, double time_s, double period_s, bool speed) {
  VectorXd row = VectorXd::Zero(unknowns.count());
  if (!speed) {
    row[0] = 1.0;
    row[1] = drive.amplitude[0].real();
  }
  for (int n = 1; n <= unknowns.harmonics; ++n) {
    const double omega = 2.0 * std::numbers::pi * n / period_s;
    Complex current = drive.amplitude[static_cast<std::size_t>(n)] * std::polar(1.0, omega * time_s);
    if (speed) current *= Complex(0.0, omega);
    row[2 * n] = current.real();
    row[2 * n + 1] = -current.imag();
  }
  return row;
}

VectorXd nominal_unknowns(const Unknowns& unknowns, const LensResponse& nominal) {
  VectorXd values = VectorXd::Zero(unknowns.count());
  values[1] = factor_of(nominal, 0).real();
  for (int n = 1; n <= unknowns.harmonics; ++n) {
    const Complex factor = factor_of(nominal, n);
    values[2 * n] = factor.real();
    values[2 * n + 1] = factor.imag();
  }
  return values;
}

struct Solution {
  VectorXd values;
  MatrixXd covariance;
  double residual_d = 0.0;
  int used = 0;
};

Fault too_few(const std::string& where, const std::string& message) {
  return {"measure.passages", where, message,
          "see that both lines are sharp within the sweep, and that the sensor sees them one at a time"};
}

class Fit {
 public:
  Fit(const LensFitTask& task, const std::vector<Seen>& seen, int harmonics, std::string where)
      : task_(task), seen_(seen), unknowns_{harmonics, task.targets.size()}, where_(std::move(where)) {}

  const Unknowns& unknowns() const { return unknowns_; }

  /// Again and again from `first`: which way each power is passed, and how fast, comes from the solution before.
  Result<Solution> solve(VectorXd first) const {
    Solution solution;
    solution.values = std::move(first);
    for (int turn = 0; turn < 6; ++turn) {
      Result<Solution> next = step(solution.values, turn >= 3);
      if (!next) return next;
      solution = std::move(*next);
    }
    return solution;
  }

 private:
  /// One crossing as an equation.
  struct Equation {
    VectorXd row;
    double power_d = 0.0;
    double spread_d = 0.0;
    std::size_t target = 0;
  };

  std::vector<Equation> equations(const VectorXd& values, bool without_outliers) const {
    std::vector<double> speed;
    double greatest = 0.0;
    for (const Seen& seen : seen_) {
      const VectorXd row = power_row(unknowns_, task_.drives[seen.drive], seen.crossing.time_s, task_.period_s, true);
      speed.push_back(row.dot(values));
      greatest = std::max(greatest, std::abs(speed.back()));
    }
    std::vector<Equation> found;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      if (std::abs(speed[i]) < least_speed * greatest) continue;
      const Seen& seen = seen_[i];
      Equation equation{power_row(unknowns_, task_.drives[seen.drive], seen.crossing.time_s, task_.period_s, false),
                        task_.targets[seen.target].power_d,
                        std::hypot(seen.crossing.spread_s * speed[i], least_spread_d), seen.target};
      // On its way to the line's own power while the light rises: below it where the power rises.
      const bool below = seen.crossing.rises == (speed[i] > 0.0);
      equation.row[unknowns_.width(seen.target)] = below ? 1.0 : -1.0;
      found.push_back(std::move(equation));
    }
    if (!without_outliers || found.empty()) return found;
    std::vector<double> off;
    for (const Equation& equation : found) {
      off.push_back(std::abs(equation.row.dot(values) - equation.power_d) / equation.spread_d);
    }
    std::vector<double> sorted = off;
    std::ranges::nth_element(sorted, sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2));
    const double usual = std::max(1.0, sorted[sorted.size() / 2] / 0.6745);
    std::vector<Equation> kept;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (off[i] < outlier * usual) kept.push_back(found[i]);
    }
    return kept;
  }

  Result<Solution> step(const VectorXd& values, bool without_outliers) const {
    const std::vector<Equation> all = equations(values, without_outliers);
    const auto rows = static_cast<Index>(all.size());
    if (rows < unknowns_.count() + 4) {
      return too_few(where_, std::to_string(rows) + " passages of known powers were seen, for " +
                                 std::to_string(unknowns_.count()) + " unknowns");
    }
    MatrixXd matrix(rows, unknowns_.count());
    VectorXd wanted(rows);
    MatrixXd by_target = MatrixXd::Zero(rows, static_cast<Index>(task_.targets.size()));
    for (Index i = 0; i < rows; ++i) {
      const Equation& equation = all[static_cast<std::size_t>(i)];
      matrix.row(i) = equation.row.transpose() / equation.spread_d;
      wanted[i] = equation.power_d / equation.spread_d;
      by_target(i, static_cast<Index>(equation.target)) = 1.0 / equation.spread_d;
    }
    const VectorXd scale = matrix.colwise().norm().cwiseMax(1e-300);
    const Eigen::ColPivHouseholderQR<MatrixXd> solver(matrix * scale.cwiseInverse().asDiagonal());
    const auto pivots = solver.matrixR().diagonal().cwiseAbs();
    if (!(pivots.minCoeff() > 1e-4 * pivots.maxCoeff())) {
      return too_few(where_, "the passages that were seen do not tell the lens's harmonics apart");
    }
    const auto solved = [&](const auto& right) -> MatrixXd {
      return scale.cwiseInverse().asDiagonal() * solver.solve(right);
    };
    Solution solution;
    solution.values = solved(wanted);
    solution.used = static_cast<int>(rows);
    const VectorXd off = matrix * solution.values - wanted;
    const double freedom = static_cast<double>(rows - unknowns_.count());
    const double excess = std::max(1.0, off.squaredNorm() / freedom);
    double squares = 0.0;
    for (Index i = 0; i < rows; ++i) {
      squares += std::pow(off[i] * all[static_cast<std::size_t>(i)].spread_d, 2);
    }
    solution.residual_d = std::sqrt(squares / freedom);
    const MatrixXd inverse = solved(MatrixXd(MatrixXd::Identity(rows, rows)));
    solution.covariance = excess * inverse * inverse.transpose();
    // The known powers' own spreads: the same for all crossings of a line.
    const MatrixXd slopes = inverse * by_target;
    for (std::size_t k = 0; k < task_.targets.size(); ++k) {
      const VectorXd slope = slopes.col(static_cast<Index>(k));
      solution.covariance += std::pow(task_.targets[k].spread_d, 2) * slope * slope.transpose();
    }
    return solution;
  }

  const LensFitTask& task_;
  const std::vector<Seen>& seen_;
  Unknowns unknowns_;
  std::string where_;
};

std::string name_of(const std::string& where, const KnownPower& target) {
  return where + ", the line at " + short_text(target.power_d, 3) + " D";
}

/// Between which values the light of a line moves, over all drives.
LightRange range_of(const std::vector<LensLook>& looks, std::size_t target, double step_s) {
  std::vector<double> lows;
  std::vector<double> highs;
  for (const LensLook& look : looks) {
    if (look.target != target || look.shares.empty()) continue;
    const LightRange range = light_range(look.shares, step_s);
    lows.push_back(range.low);
    highs.push_back(range.high);
  }
  if (lows.empty()) return {};
  std::ranges::sort(lows);
  std::ranges::sort(highs);
  return {lows.front(), highs[highs.size() / 2]};
}

Result<std::vector<LightRange>> ranges_of(const std::vector<LensLook>& looks, const LensFitTask& task,
                                          const std::string& where) {
  std::vector<LightRange> ranges;
  double best = 0.0;
  for (std::size_t target = 0; target < task.targets.size(); ++target) {
    ranges.push_back(range_of(looks, target, task.step_s));
    best = std::max(best, ranges.back().high - ranges.back().low);
  }
  for (std::size_t target = 0; target < task.targets.size(); ++target) {
    const double height = ranges[target].high - ranges[target].low;
    if (height > least_height && height > least_of_best * best) continue;
    return Fault{"measure.light", name_of(where, task.targets[target]),
                 "its light never rises: it is not seen, or never sharp",
                 "light it with the lens at rest and look through the sensor's slit; correct its pixels or its power"};
  }
  return ranges;
}

/// The crossings of each line's own level, halfway up its light.
Result<std::vector<Seen>> crossings_of(const std::vector<LensLook>& looks, const LensFitTask& task,
                                       const std::string& where) {
  const Result<std::vector<LightRange>> ranges = ranges_of(looks, task, where);
  if (!ranges) return ranges.fault();
  std::vector<Seen> all;
  std::vector<int> rising(task.targets.size(), 0);
  for (const LensLook& look : looks) {
    const LightRange& range = (*ranges)[look.target];
    const double height = range.high - range.low;
    for (const Crossing& crossing : crossings(look.shares, range.low + 0.5 * height, height, task.step_s)) {
      all.push_back({look.drive, look.target, crossing});
      rising[look.target] += crossing.rises ? 1 : 0;
    }
  }
  for (std::size_t target = 0; target < rising.size(); ++target) {
    if (rising[target] >= 4) continue;
    return too_few(name_of(where, task.targets[target]),
                   std::to_string(rising[target]) + " passages were seen, over all drives");
  }
  return all;
}

/// A lens that goes the other way than thought, or lines that are the other way round.
bool is_backward(const Solution& solution, const LensResponse& nominal) {
  const Complex found(solution.values[2], solution.values[3]);
  return solution.values[1] * factor_of(nominal, 0).real() < 0.0 ||
         (found * std::conj(factor_of(nominal, 1))).real() < 0.0;
}

MeasuredHarmonic harmonic_of(const Solution& solution, int n, double period_s, double delay_spread_s) {
  if (n == 0) return {0, {solution.values[1], std::sqrt(solution.covariance(1, 1))}, {0.0, 0.0}};
  const double a = solution.values[2 * n];
  const double b = solution.values[2 * n + 1];
  const Eigen::Matrix2d covariance = solution.covariance.block<2, 2>(2 * n, 2 * n);
  const double gain = std::hypot(a, b);
  const Eigen::Vector2d along(a / gain, b / gain);
  const Eigen::Vector2d across(-b / gain, a / gain);
  const double delay_deg = 360.0 * n * delay_spread_s / period_s;
  const double turn_deg = std::sqrt(across.dot(covariance * across)) / gain * degrees;
  return {n,
          {gain, std::sqrt(along.dot(covariance * along))},
          {std::atan2(b, a) * degrees, std::hypot(turn_deg, delay_deg)}};
}

/// A delay turns each harmonic further than the one before: by whole turns nearest to that, so that what lies between
/// two harmonics may be read off a straight line.
void unwind(std::vector<MeasuredHarmonic>& lens) {
  for (std::size_t n = 2; n < lens.size(); ++n) {
    const double expected_deg = 2.0 * lens[n - 1].phase_deg.value - lens[n - 2].phase_deg.value;
    double& phase_deg = lens[n].phase_deg.value;
    phase_deg += 360.0 * std::round((expected_deg - phase_deg) / 360.0);
  }
}

}  // namespace

Result<LensFit> fit_lens(const std::vector<LensLook>& looks, const LensFitTask& task, const std::string& where) {
  const Result<std::vector<Seen>> seen = crossings_of(looks, task, where);
  if (!seen) return seen.fault();
  // First the plain sweeps alone: there nobody doubts which way a power is passed.
  std::vector<Seen> plain;
  for (const Seen& one : *seen) {
    const auto& tones = task.drives[one.drive].amplitude;
    if (std::all_of(tones.begin() + 2, tones.end(), [](const Complex& tone) { return tone == 0.0; })) {
      plain.push_back(one);
    }
  }
  const Fit first(task, plain, 1, where);
  Result<Solution> sweep = first.solve(nominal_unknowns(first.unknowns(), task.nominal));
  if (!sweep) return sweep.fault();
  const int harmonics = static_cast<int>(task.drives.front().amplitude.size()) - 1;
  const Fit whole(task, *seen, harmonics, where);
  VectorXd start = nominal_unknowns(whole.unknowns(), task.nominal);
  start.head(4) = sweep->values.head(4);
  start.tail(static_cast<Index>(task.targets.size())) = sweep->values.tail(static_cast<Index>(task.targets.size()));
  const Result<Solution> solution = whole.solve(start);
  if (!solution) return solution.fault();
  if (solution->residual_d > most_residual_d || 4 * solution->used < 3 * static_cast<int>(seen->size())) {
    return Fault{"measure.lens", where,
                 "what was seen is off by " + short_text(solution->residual_d, 3) + " D from any linear lens, over " +
                     std::to_string(solution->used) + " of " + std::to_string(seen->size()) + " passages",
                 "see that the lines are where devices.light_sensor.targets says, and each seen by its own eye alone"};
  }
  if (is_backward(*solution, task.nominal)) {
    return Fault{"measure.lens", where, "its power falls where it should rise",
                 "see that devices.light_sensor.targets does not mix up the lines, and that the lens's poles are not"};
  }
  LensFit fit;
  fit.rest_power_d = {solution->values[0], std::sqrt(solution->covariance(0, 0))};
  for (int n = 0; n <= harmonics; ++n) {
    fit.lens.push_back(harmonic_of(*solution, n, task.period_s, task.delay_spread_s));
  }
  unwind(fit.lens);
  fit.residual_d = solution->residual_d;
  fit.crossings = solution->used;
  return fit;
}

}  // namespace focalstage
