#pragma once

#include <optional>

#include "core/schedule/shape_task.h"

namespace focalstage {

/// The curve whose power changes least while the slices are shown: the worst of them first, their mean second. Nothing
/// where no curve is found that shows all of them within the limits.
///
/// Given the instants of the slices, this is a linear program in the curve's coefficients: the power of each slice at
/// its instant, monotonic halves and limits of current are linear, the smear is a difference of two powers, and the
/// root mean square of the current is convex. The instants join as unknowns by successive linearisation: each program
/// is solved within a trust region about the curve so far, its step shortened until the exposures that the curve itself
/// asks for have less smear (R. E. Griffith and R. A. Stewart, A nonlinear programming technique..., Management Science
/// 7(4), 1961).
///
/// At most 40 programs, so bounded in time (0.1 to 0.2 s for 24 harmonics); no two runs differ.
std::optional<HarmonicCurve> shape_curve(const ShapeTask& task, const std::optional<DriveTask>& drive);

}  // namespace focalstage
