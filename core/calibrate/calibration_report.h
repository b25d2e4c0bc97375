#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "core/base/result.h"

namespace focalstage {

/// How one point agrees with the calibrated projector.
struct PointResidual {
  std::string name;                   ///< for whoever reads it: "3 (left corner)"
  glm::dvec2 pixel{0.0};              ///< where the projector's picture was said to meet it
  glm::dvec2 off_px{0.0};             ///< where the calibrated projector puts it, less that
  double distance_px = 0.0;           ///< the length of it
  std::optional<double> left_out_px;  ///< the same by all others alone; none where those do not suffice
};

/// Which parts of the picture have points: what lies outside is said by nobody.
struct Coverage {
  static constexpr int columns = 8;
  static constexpr int rows = 6;
  std::vector<int> counts;     ///< points per cell of 8 x 6, from the top left
  double hull_share = 0.0;     ///< of the picture: the convex hull of all points
  double touched_share = 0.0;  ///< of the cells: those with a point
};

/// What a calibration may be off by, one standard deviation, if errors are as large as the residuals say and
/// independent.
struct PoseUncertainty {
  double position_mm = 0.0;  ///< root of the three axes' variances
  double rotation_deg = 0.0;
  std::optional<double> focal_px;   ///< where it was free
  std::optional<double> centre_px;  ///< where it was free: root of both variances
};

struct CalibrationReport {
  std::vector<PointResidual> residuals;
  double median_px = 0.0;
  double p95_px = 0.0;  ///< 95 % are no worse
  double worst_px = 0.0;
  std::size_t worst = 0;                     ///< which of `residuals`
  std::optional<double> left_out_median_px;  ///< half of new points would land further off than this
  Coverage coverage;
  PoseUncertainty uncertainty;
};

inline constexpr double calibration_limit_px = 1.0;

/// Median, 95 %, worst and left-out of `residuals`, and coverage of a picture of that size.
CalibrationReport report_of(std::vector<PointResidual> residuals, int width_px, int height_px);

/// Whether a result may be applied: half of its residuals, with a point's own say and without, must be under the limit,
/// and 95 % under three times it. Else "calibrate.limit", with the worst point.
Status check_limit(const CalibrationReport& report, double limit_px = calibration_limit_px);

}  // namespace focalstage
