#pragma once

#include <filesystem>
#include <stop_token>
#include <vector>

#include "core/base/result.h"
#include "core/base/sides.h"
#include "editor/viewer/pattern.h"
#include "editor/viewer/seen_pattern.h"
#include "editor/viewer/two_choice.h"

namespace focalstage {

// Whether the lens has the power it is asked for, seen by an eye whose focus is known and does not move. On a surface
// at distance d it sees sharply through the power 1/d - A, A its focus, whatever that power is called. Two charts of
// fine lines are shown a little above and a little below a power; they are equally blurred where the true power between
// them is that one. The charts are moved through the sweep together until they are.

/// The charts, a project for each level: how far both are moved from the power in question.
struct FocusCharts {
  std::vector<Source> sources;
  std::vector<double> moved_d;  ///< rising
  Side eye = Side::left;
  double power_d = 0.0;    ///< in question: what such an eye sees sharply through on this surface
  double focus_d = 0.0;    ///< the eye's, as a vergence at the lens
  double line_deg = 0.0;   ///< width of a pair of lines, as seen
  double surface_m = 0.0;  ///< from the pupil along the gaze
};

/// Of the charts from the power between them.
inline constexpr double chart_apart_d = 0.35;

/// For an eye focused `focus_m` before its lens. Faults "viewer.surface", "viewer.refused", and those of the stage.
Result<FocusCharts> focus_charts(const Source& from, Side eye, double focus_m);

/// The test: the upper chart, of more power, is the first. Shows lie in `folder`. Levels that the sweep does not reach
/// are left out; fault "viewer.unreachable" where too few are left.
Result<TwoChoiceTest> chart_test(const FocusCharts& charts, const std::filesystem::path& folder,
                                 const FrameProgress& progress, const std::stop_token& stop);

/// Logarithm of the upper chart's contrast over the lower's, root mean square over mean, as the retina receives them.
Result<double> seen_chart_difference(const ShowReader& show, const TrueEye& eye);

/// An eye at the charts' focus behind a lens with so much more power than it is asked for.
TrueEye eye_at_charts(const FocusCharts& charts, double power_error_d);

/// What a run of the test says of the lens.
struct LensPowerCheck {
  double asked_d = 0.0;
  double error_d = 0.0;        ///< true less asked
  double answers_d = 0.0;      ///< one standard deviation, of the answers
  double focus_d = 0.0;        ///< the same, of the eye's focus
  double uncertainty_d = 0.0;  ///< of both
  bool differs = false;        ///< by more than two standard deviations
};
LensPowerCheck lens_power_check(const FocusCharts& charts, const EqualityEstimate& found, double focus_uncertainty_d);

}  // namespace focalstage
