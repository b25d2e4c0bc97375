#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/calibrate/picked_points.h"
#include "core/optics/projector_model.h"

namespace focalstage {

// The room's own: what includes this sees Eigen.

/// The projector whose pixels lie nearest to the points, and how well they say so.
struct ProjectorFit {
  ProjectorModel model;
  std::vector<glm::dvec2> off_px;  ///< per point: where the model puts it, less where it was picked
  double square_sum_px2 = 0.0;
  int unknowns = 0;
  /// For residuals of variance one: turn about the projector's own axes (rad), position in the world (m), then what
  /// else was free: the logarithm of the focal length, the centre (px).
  Eigen::MatrixXd covariance;
};

int unknowns_of(LensFreedom freedom);

/// From `start` downhill. None where a point of the start lies behind it, or they do not determine what is free.
std::optional<ProjectorFit> fit_projector(const ProjectorModel& start, const std::vector<PickedPoint>& points,
                                          LensFreedom freedom);

}  // namespace focalstage
