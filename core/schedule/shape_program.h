#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/schedule/linear_program.h"
#include "core/schedule/shape_task.h"

namespace focalstage {

/// The task of `shape_curve` as linear programs. Times are phases here: radians of the period.
class ShapeProgram {
 public:
  ShapeProgram(const ShapeTask& task, const std::optional<DriveTask>& drive);

  /// The program about a curve that passes the slices' powers at `phase`, none of which may move by more than `trust`.
  /// Its first unknowns are the coefficients of the better curve.
  LinearProgram around(const HarmonicCurve& curve, const std::vector<double>& phase, double trust) const;

  std::size_t coefficients() const { return coefficients_; }
  double half_exposure() const { return half_exposure_; }
  double pitch() const { return pitch_; }  ///< between two slices
  double first() const { return first_; }  ///< the earliest and the latest that a slice may be passed
  double last() const { return last_; }

  /// The drive that makes the curve; empty where no lens is asked.
  std::vector<double> drive_a(const HarmonicCurve& curve) const;

 private:
  // The unknowns: coefficients, the slices' phases, the worst smear, the lateness that has to be borne.
  std::size_t phase_at(std::size_t slice) const { return coefficients_ + slice; }
  std::size_t worst_at() const { return coefficients_ + task_.powers_d.size(); }
  std::size_t late_at() const { return worst_at() + 1; }
  std::size_t unknowns() const { return late_at() + 1; }

  void make_drive_rows();
  std::vector<double> power_row(double phase) const;
  void add_halves(LinearProgram& program) const;
  void add_range(LinearProgram& program) const;
  void add_slice(LinearProgram& program, const HarmonicCurve& curve, std::size_t slice, double phase) const;
  void add_times(LinearProgram& program, const std::vector<double>& phase, double trust) const;
  void add_drive(LinearProgram& program, const HarmonicCurve& curve) const;

  const ShapeTask& task_;
  const std::optional<DriveTask>& drive_;
  std::size_t coefficients_ = 1;
  Rows power_rows_;  ///< times the coefficients: the samples of power
  Rows drive_rows_;  ///< the samples of drive
  double half_exposure_ = 0.0;
  double pitch_ = 0.0;
  double first_ = 0.0;
  double last_ = 0.0;
};

/// What being late or asking too much counts in the search, beside the smear in dioptres.
inline constexpr double late_weight_d = 10.0;   ///< per radian of overlap or of a moving shutter
inline constexpr double over_weight_d = 100.0;  ///< per ampere beyond a limit
inline constexpr double mean_weight = 0.1;      ///< of the mean smear beside the worst

}  // namespace focalstage
