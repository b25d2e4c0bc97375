#include "core/calibrate/projector_fit.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "core/calibrate/least_squares.h"
#include "core/calibrate/rigid_step.h"

namespace focalstage {

namespace {

/// Scales at which a change of each unknown moves pixels about alike, a metre or so away.
Eigen::VectorXd scale_of(int unknowns, double focal_px) {
  Eigen::VectorXd scale(9);
  scale << 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, focal_px, focal_px;
  return scale.head(unknowns);
}

ProjectorModel changed(const ProjectorModel& start, const Eigen::VectorXd& by) {
  ProjectorModel model = start;
  model.world_from_projector = stepped(start.world_from_projector, by.head(6));
  if (by.size() > 6) model.focal_px *= std::exp(by(6));
  if (by.size() > 8) model.centre_px += glm::dvec2(by(7), by(8));
  return model;
}

}  // namespace

int unknowns_of(LensFreedom freedom) {
  return freedom == LensFreedom::fixed ? 6 : freedom == LensFreedom::focal ? 7 : 9;
}

std::optional<ProjectorFit> fit_projector(const ProjectorModel& start, const std::vector<PickedPoint>& points,
                                          LensFreedom freedom) {
  const int unknowns = unknowns_of(freedom);
  const auto residuals = [&](const Eigen::VectorXd& by, Eigen::VectorXd& out) {
    const ProjectorModel model = changed(start, by);
    out.resize(2 * static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto pixel = pixel_of_world(model, points[i].world_m);
      if (!pixel) return false;
      const glm::dvec2 off = *pixel - points[i].pixel;
      out(2 * static_cast<Eigen::Index>(i)) = off.x;
      out(2 * static_cast<Eigen::Index>(i) + 1) = off.y;
    }
    return true;
  };
  const auto solved = least_squares(residuals, Eigen::VectorXd::Zero(unknowns), scale_of(unknowns, start.focal_px.x));
  if (!solved) return std::nullopt;
  ProjectorFit fit{changed(start, solved->unknowns), {}, solved->square_sum(), unknowns, solved->covariance};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = 2 * static_cast<Eigen::Index>(i);
    fit.off_px.emplace_back(solved->residuals(row), solved->residuals(row + 1));
  }
  return fit;
}

}  // namespace focalstage
