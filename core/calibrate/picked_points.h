#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/result.h"
#include "core/calibrate/calibration_report.h"
#include "core/optics/projector_model.h"

namespace focalstage {

/// A place in the room, and the projector's pixel that lights it.
struct PickedPoint {
  std::string name;  ///< for whoever reads the residuals; may be empty
  glm::dvec3 world_m{0.0};
  glm::dvec2 pixel{0.0};  ///< pixel i covers [i, i + 1)
};

/// What of the lens points may say beside the pose. Distortion stays as it is: it takes a scan.
enum class LensFreedom {
  fixed,   ///< the lens is known; six points or more
  focal,   ///< one focal length, fx : fy as it is; seven or more, not in one plane
  centre,  ///< the principal point too; eight or more
};

struct ProjectorCalibration {
  ProjectorModel model;
  CalibrationReport report;
};

/// The projector that lights the points where they were picked, by least squares over our own projection
/// (core/optics). Where it starts is found by subsets of the points (P. J. Rousseeuw, "Least median of squares
/// regression", 1984; poses by G. Terzakis and M. Lourakis, "A consistently fast and globally optimal solution to the
/// perspective-n-point problem", 2020), so that what lies neither draws it off nor goes unnoticed. `known` gives the
/// picture's size and the lens; its pose is not looked at. Refuses rather than guesses:
///
/// "points.few"        fewer than what is asked takes
/// "points.finite"     a coordinate that is no number. Named, as is each point below.
/// "points.outside"    a pixel that the picture has not got
/// "points.twice"      two points in one place, or on one pixel
/// "points.collinear"  points on one line, in the room or in the picture
/// "points.coplanar"   points in one plane, where the lens is asked for too
/// "points.ambiguous"  two poses that differ by more than 5 degrees fit within a factor of two
/// "points.lying"      some disagree with all others beyond chance (F test with Bonferroni's correction, p < 0.001)
/// "points.exchanged"  two lie, and would not with their pixels exchanged
/// "points.behind"     some lie behind the projector that the others tell of
/// "points.mirrored"   an axis points the wrong way, in the room or in the picture
/// "points.mismatched" no pose agrees with 60 % of them, and at least five, to a hundredth of the picture's diagonal
/// "points.weak"       they fit, but do not tell the focal length to a twentieth
Result<ProjectorCalibration> calibrate_by_points(const ProjectorModel& known, const std::vector<PickedPoint>& points,
                                                 LensFreedom freedom);

/// "3 (left corner)", counted from 1.
std::string point_label(const std::vector<PickedPoint>& points, std::size_t index);

}  // namespace focalstage
