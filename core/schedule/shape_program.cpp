#include "core/schedule/shape_program.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/schedule/lens_response.h"

namespace focalstage {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

/// A half is nowhere slower than this share of the sine that spans the slices: strictly monotonic, and in the decimals
/// of a file too.
constexpr double least_slope_share = 0.01;
/// Kept from shutters and neighbours, because a slice is passed a little beside where a linear program has it.
constexpr double spare_s = 5e-6;
/// Kept from the limits of current, for the same reason.
constexpr double current_share = 0.999;
/// Samples of less than this share of the limit have no row: a step that takes one of them beyond is shortened.
constexpr double near_limit = 0.6;
/// Rows in amperes beside rows in dioptres.
constexpr double current_scale = 10.0;
/// Of all curves as good, the smoothest: the cost of a harmonic's square, times its number to the fourth.
constexpr double roughness = 1e-7;

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) sum += a[i] * b[i];
  return sum;
}

void harmonics_at(double phase, std::span<double> row) {
  row[0] = 1.0;
  for (std::size_t c = 1; c + 1 < row.size(); c += 2) {
    const double angle = static_cast<double>(c / 2 + 1) * phase;
    row[c] = std::cos(angle);
    row[c + 1] = std::sin(angle);
  }
}

/// Dioptres per radian.
double slope_of(const HarmonicCurve& curve, double phase) {
  double slope = 0.0;
  for (std::size_t c = 1; c + 1 < curve.size(); c += 2) {
    const auto n = static_cast<double>(c / 2 + 1);
    slope += n * (curve[c + 1] * std::cos(n * phase) - curve[c] * std::sin(n * phase));
  }
  return slope;
}

double sample_phase(std::size_t sample, std::size_t count) {
  return turn * static_cast<double>(sample) / static_cast<double>(count);
}

}  // namespace

std::vector<double> samples_of(const HarmonicCurve& curve, std::size_t count) {
  std::vector<double> samples(count);
  std::vector<double> row(curve.size());
  for (std::size_t i = 0; i < count; ++i) {
    harmonics_at(sample_phase(i, count), row);
    samples[i] = dot(row, curve);
  }
  return samples;
}

ShapeProgram::ShapeProgram(const ShapeTask& task, const std::optional<DriveTask>& drive)
    : task_(task), drive_(drive), coefficients_(1 + 2 * static_cast<std::size_t>(task.highest_harmonic)) {
  power_rows_.width = drive_rows_.width = coefficients_;
  for (std::size_t i = 0; i < task.samples; ++i) harmonics_at(sample_phase(i, task.samples), power_rows_.add());
  const double per_second = turn / task.period_s;
  half_exposure_ = per_second * task.exposure_s / 2.0;
  pitch_ = per_second * (task.pitch_s + spare_s);
  first_ = per_second * (task.clear.from_s + spare_s) + half_exposure_;
  last_ = per_second * (task.clear.to_s - spare_s) - half_exposure_;
  if (drive_) make_drive_rows();
}

void ShapeProgram::make_drive_rows() {
  drive_rows_.numbers.resize(task_.samples * coefficients_);
  std::vector<double> power_d(task_.samples);
  for (std::size_t c = 0; c < coefficients_; ++c) {
    for (std::size_t i = 0; i < task_.samples; ++i) {
      power_d[i] = power_rows_[drive_->falling ? (task_.samples - i) % task_.samples : i][c];
    }
    const std::vector<double> drive_a = drive_for_power(power_d, drive_->response);
    for (std::size_t i = 0; i < task_.samples; ++i) drive_rows_.numbers[i * coefficients_ + c] = drive_a[i];
  }
}

std::vector<double> ShapeProgram::drive_a(const HarmonicCurve& curve) const {
  std::vector<double> drive_a(drive_rows_.count());
  for (std::size_t i = 0; i < drive_a.size(); ++i) drive_a[i] = dot(drive_rows_[i], curve);
  return drive_a;
}

/// Times the coefficients: the power at `phase` on the straight line between two samples.
std::vector<double> ShapeProgram::power_row(double phase) const {
  const auto count = static_cast<double>(task_.samples);
  const double place = (phase / turn - std::floor(phase / turn)) * count;
  const std::size_t i = static_cast<std::size_t>(place) % task_.samples;
  const std::span<const double> before = power_rows_[i];
  const std::span<const double> after = power_rows_[(i + 1) % task_.samples];
  std::vector<double> row(coefficients_);
  for (std::size_t c = 0; c < coefficients_; ++c) row[c] = std::lerp(before[c], after[c], place - std::floor(place));
  return row;
}

LinearProgram ShapeProgram::around(const HarmonicCurve& curve, const std::vector<double>& phase, double trust) const {
  LinearProgram program;
  program.cost.assign(unknowns(), 0.0);
  program.cost[worst_at()] = 1.0;
  program.cost[late_at()] = late_weight_d;
  program.ridge.assign(unknowns(), 0.0);
  for (std::size_t c = 1; c < coefficients_; ++c) {
    program.ridge[c] = roughness * std::pow(static_cast<double>((c + 1) / 2), 4.0);
  }
  program.at_most.width = program.equal.width = unknowns();
  add_halves(program);
  add_range(program);
  for (std::size_t k = 0; k < task_.powers_d.size(); ++k) add_slice(program, curve, k, phase[k]);
  add_times(program, phase, trust);
  if (drive_) add_drive(program, curve);
  return program;
}

/// Up in the first half, down in the second, from sample to sample.
void ShapeProgram::add_halves(LinearProgram& program) const {
  const double per_radian = static_cast<double>(task_.samples) / turn;
  const double span_d = std::max(0.1, task_.powers_d.back() - task_.powers_d.front());
  for (std::size_t i = 0; i < task_.samples; ++i) {
    const std::span<const double> from = power_rows_[i];
    const std::span<const double> to = power_rows_[(i + 1) % task_.samples];
    const double sign = 2 * i < task_.samples ? -1.0 : 1.0;
    const std::span<double> row = program.at_most.add();
    for (std::size_t c = 0; c < coefficients_; ++c) row[c] = sign * (to[c] - from[c]) * per_radian;
    const double sine_d_per_radian = std::abs(to[1] - from[1]) * per_radian * span_d / 2.0;
    program.most.push_back(-least_slope_share * sine_d_per_radian);
  }
}

void ShapeProgram::add_range(LinearProgram& program) const {
  const std::span<double> bottom = program.at_most.add();
  for (std::size_t c = 0; c < coefficients_; ++c) bottom[c] = -power_rows_[0][c];
  program.most.push_back(-task_.lowest_d);
  const std::span<double> top = program.at_most.add();
  for (std::size_t c = 0; c < coefficients_; ++c) top[c] = power_rows_[task_.samples / 2][c];
  program.most.push_back(task_.highest_d);
}

/// The slice's power at its instant, and its smear below the worst: P(t) + P'(t0) (t - t0), and the same for the
/// difference of its ends.
void ShapeProgram::add_slice(LinearProgram& program, const HarmonicCurve& curve, std::size_t slice,
                             double phase) const {
  const double slope = slope_of(curve, phase);
  const std::vector<double> here = power_row(phase);
  const std::span<double> equal = program.equal.add();
  std::copy(here.begin(), here.end(), equal.begin());
  equal[phase_at(slice)] = slope;
  program.exactly.push_back(task_.powers_d[slice] + slope * phase);

  const std::vector<double> after = power_row(phase + half_exposure_);
  const std::vector<double> before = power_row(phase - half_exposure_);
  const double bend = slope_of(curve, phase + half_exposure_) - slope_of(curve, phase - half_exposure_);
  const std::span<double> smear = program.at_most.add();
  for (std::size_t c = 0; c < coefficients_; ++c) smear[c] = after[c] - before[c];
  smear[phase_at(slice)] = bend;
  const double weight = mean_weight / static_cast<double>(task_.powers_d.size());
  for (std::size_t j = 0; j < smear.size(); ++j) program.cost[j] += weight * smear[j];
  smear[worst_at()] = -1.0;
  program.most.push_back(bend * phase);
}

/// The slices one after another between the shutters, and near where they were.
void ShapeProgram::add_times(LinearProgram& program, const std::vector<double>& phase, double trust) const {
  const auto bound = [&](std::size_t slice, double sign, double most) {
    const std::span<double> row = program.at_most.add();
    row[phase_at(slice)] = sign;
    program.most.push_back(most);
    return row;
  };
  for (std::size_t k = 0; k < phase.size(); ++k) {
    bound(k, 1.0, phase[k] + trust);
    bound(k, -1.0, trust - phase[k]);
    if (k > 0) {
      const std::span<double> row = bound(k, -1.0, -pitch_);
      row[phase_at(k - 1)] = 1.0;
      row[late_at()] = -1.0;
    }
  }
  bound(0, -1.0, -first_)[late_at()] = -1.0;
  bound(phase.size() - 1, 1.0, last_)[late_at()] = -1.0;
  program.at_most.add()[late_at()] = -1.0;
  program.most.push_back(0.0);
}

void ShapeProgram::add_drive(LinearProgram& program, const HarmonicCurve& curve) const {
  std::vector<double> gradient(coefficients_, 0.0);
  double square = 0.0;
  for (std::size_t i = 0; i < task_.samples; ++i) {
    const std::span<const double> drive = drive_rows_[i];
    const double current_a = dot(drive, curve);
    square += current_a * current_a;
    for (std::size_t c = 0; c < coefficients_; ++c) gradient[c] += drive[c] * current_a;
    if (std::abs(current_a) < near_limit * drive_->max_current_a) continue;
    const std::span<double> row = program.at_most.add();
    for (std::size_t c = 0; c < coefficients_; ++c) row[c] = std::copysign(current_scale, current_a) * drive[c];
    program.most.push_back(current_scale * current_share * drive_->max_current_a);
  }
  // The root mean square is convex: what its tangent at this curve forbids is forbidden.
  const auto count = static_cast<double>(task_.samples);
  const double rms_a = std::max(1e-9, std::sqrt(square / count));
  const std::span<double> row = program.at_most.add();
  for (std::size_t c = 0; c < coefficients_; ++c) row[c] = current_scale * gradient[c] / count / rms_a;
  program.most.push_back(current_scale * current_share * drive_->max_rms_current_a);
}

}  // namespace focalstage
