#include "core/calibrate/picked_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/SVD>
#include <glm/geometric.hpp>

#include "core/base/number_words.h"
#include "core/calibrate/consensus.h"
#include "core/calibrate/first_poses.h"

namespace focalstage {

namespace {

constexpr double thinnest = 0.02;       // spread beside a line or plane, of that along it
constexpr double alike_factor = 2.0;    // another pose must fit so many times worse,
constexpr double alike_rad = 0.0873;    // or differ by less than 5 degrees
constexpr double weakest_focal = 0.05;  // standard deviation of the focal length, of itself
constexpr double mirror_px = 2.0;       // who is nearer than this fits no mirror image
constexpr double mirror_factor = 5.0;   // how much better the mirror image must fit
constexpr double farthest = 0.01;       // of the picture's diagonal: beyond it is no pose
constexpr double same_m = 1e-6;         // apart
constexpr double same_px = 1e-3;        // apart
constexpr double rad_to_deg = 180.0 / std::numbers::pi;

using Points = std::vector<PickedPoint>;

std::string labels(const Points& points, const std::vector<std::size_t>& which) {
  std::string text = which.size() == 1 ? "point " : "points ";
  for (std::size_t k = 0; k < which.size(); ++k) text += (k == 0 ? "" : ", ") + point_label(points, which[k]);
  return text;
}

double farthest_px(const ProjectorModel& known) { return farthest * std::hypot(known.width_px, known.height_px); }

std::size_t least_points(LensFreedom freedom) {
  return freedom == LensFreedom::fixed ? 6 : freedom == LensFreedom::focal ? 7 : 8;
}

Status check_count(const Points& points, LensFreedom freedom) {
  const std::size_t least = least_points(freedom);
  if (points.size() >= least) return {};
  return Fault{"points.few", "points",
               "there are " + std::to_string(points.size()) + " points; " + std::to_string(least) + " is the least",
               "pick " + std::to_string(least) + " or more, spread over the picture and in depth"};
}

Status check_each(const ProjectorModel& known, const Points& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PickedPoint& p = points[i];
    const std::string where = "point " + point_label(points, i);
    if (!std::isfinite(p.world_m.x + p.world_m.y + p.world_m.z + p.pixel.x + p.pixel.y)) {
      return Fault{"points.finite", where, "a coordinate is no finite number", "measure it anew"};
    }
    if (p.pixel.x < 0.0 || p.pixel.y < 0.0 || p.pixel.x > known.width_px || p.pixel.y > known.height_px) {
      return Fault{"points.outside", where,
                   "its pixel " + short_text(p.pixel.x) + ", " + short_text(p.pixel.y) + " is not in the picture of " +
                       std::to_string(known.width_px) + " x " + std::to_string(known.height_px),
                   "see that it was picked in this projector's picture, from its top left corner"};
    }
    for (std::size_t k = 0; k < i; ++k) {
      const bool same_place = glm::distance(p.world_m, points[k].world_m) < same_m;
      if (!same_place && glm::distance(p.pixel, points[k].pixel) >= same_px) continue;
      return Fault{
          "points.twice", where,
          std::string("it has the ") + (same_place ? "place" : "pixel") + " of point " + point_label(points, k),
          "pick each place once"};
    }
  }
  return {};
}

/// The spread along the points' own axes, widest first.
Eigen::VectorXd spreads(const Eigen::MatrixXd& columns) {
  const Eigen::MatrixXd centred = columns.colwise() - columns.rowwise().mean();
  return Eigen::JacobiSVD<Eigen::MatrixXd>(centred).singularValues();
}

Status check_spread(const Points& points, LensFreedom freedom) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd world(3, count);
  Eigen::MatrixXd pixels(2, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const PickedPoint& p = points[static_cast<std::size_t>(i)];
    world.col(i) << p.world_m.x, p.world_m.y, p.world_m.z;
    pixels.col(i) << p.pixel.x, p.pixel.y;
  }
  const Eigen::VectorXd room = spreads(world);
  const Eigen::VectorXd picture = spreads(pixels);
  if (!(room(1) > thinnest * room(0))) {
    return Fault{"points.collinear", "points", "they lie on one line in the room", "pick points beside that line too"};
  }
  if (!(picture(1) > thinnest * picture(0))) {
    return Fault{"points.collinear", "points", "they lie on one line in the projector's picture",
                 "pick points beside that line too"};
  }
  if (freedom == LensFreedom::fixed || room(2) > thinnest * room(0)) return {};
  return Fault{"points.coplanar", "points", "they lie in one plane, which does not tell the lens from the distance",
               "pick points before or behind that plane too, or ask for the pose alone"};
}

double angle_between(const glm::dquat& a, const glm::dquat& b) {
  return 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(a, b))));
}

/// Nearly flat points look nearly alike from two poses.
Status check_ambiguity(const Consensus& found, const Points& points, LensFreedom freedom) {
  ProjectorModel other = found.fit.model;
  other.world_from_projector = leaning_the_other_way(other.world_from_projector, points);
  const auto fit = fit_projector(other, points, freedom);
  if (!fit) return {};
  const double floor_px2 = picking_px * picking_px * static_cast<double>(points.size());
  const double best_px2 = std::max(found.fit.square_sum_px2, floor_px2);
  const double apart =
      angle_between(found.fit.model.world_from_projector.rotation, fit->model.world_from_projector.rotation);
  if (fit->square_sum_px2 > alike_factor * alike_factor * best_px2 || apart < alike_rad) return {};
  return Fault{"points.ambiguous", "points",
               "two poses that differ by " + fixed_text(apart * rad_to_deg, 0) + " degrees fit them nearly alike",
               "pick points before or behind their plane too"};
}

double rms_px(const Consensus& found) {
  return std::sqrt(found.fit.square_sum_px2 / static_cast<double>(found.agreeing.size()));
}

bool would_agree_exchanged(const Consensus& found, const Points& points) {
  if (found.lying.size() != 2) return false;
  PickedPoint a = points[found.lying[0]];
  PickedPoint b = points[found.lying[1]];
  std::swap(a.pixel, b.pixel);
  const double near_px = 10.0 * std::max(rms_px(found), picking_px);
  return distance_px(found.fit.model, a) < near_px && distance_px(found.fit.model, b) < near_px;
}

Fault liars(const Consensus& found, const Points& points) {
  const std::string where = labels(points, found.lying);
  const std::string others =
      "the other " + std::to_string(found.agreeing.size()) + " agree to " + fixed_text(rms_px(found), 2) + " px";
  if (would_agree_exchanged(found, points)) {
    return {"points.exchanged", where, "each has the other's pixel; " + others, "exchange their pixels"};
  }
  std::string off;
  for (const std::size_t i : found.lying) {
    const double distance = distance_px(found.fit.model, points[i]);
    if (!std::isfinite(distance)) {
      return {"points.behind", "point " + point_label(points, i),
              "it lies behind the projector that the others tell of; " + others, "measure it anew, or leave it out"};
    }
    off += (off.empty() ? "" : ", ") + fixed_text(distance, 1);
  }
  return {"points.lying", where, "off by " + off + " px from where the others put it; " + others,
          "measure anew, or leave out"};
}

Status check_mirror(const std::optional<Consensus>& found, const ProjectorModel& known, Points points,
                    LensFreedom freedom) {
  if (found && found->lying.empty() && rms_px(*found) < mirror_px) return {};
  for (PickedPoint& point : points) point.pixel.x = known.width_px - point.pixel.x;
  const auto mirrored = find_consensus(known, points, freedom);
  if (!mirrored || rms_px(*mirrored) > farthest_px(known)) return {};
  const bool fits_better = !found || mirror_factor * rms_px(*mirrored) < rms_px(*found);
  const bool nobody_lies = mirrored->lying.empty() && found && !found->lying.empty();
  if (!fits_better && !nobody_lies) return {};
  return Fault{"points.mirrored", "points", "they fit their mirror image: an axis points the wrong way",
               "pixels run right and down from the top left corner; the room's axes are right-handed, +Y up"};
}

Status check_match(const std::optional<Consensus>& found, const ProjectorModel& known) {
  if (found && rms_px(*found) <= farthest_px(known)) return {};
  return Fault{"points.mismatched", "points",
               found ? "the best pose is " + fixed_text(rms_px(*found), 0) + " px off (root mean square)"
                     : "no pose of the projector agrees with five of them and 60 %",
               "see that each pixel stands beside its own place, and that the lens of the project is this projector's"};
}

Status check_focal(const ProjectorFit& fit, double variance_px2) {
  if (fit.unknowns < 7) return {};
  const double share = std::sqrt(fit.covariance(6, 6) * variance_px2);
  if (share <= weakest_focal) return {};
  return Fault{"points.weak", "points", "they tell the focal length to " + fixed_text(100.0 * share, 0) + " % alone",
               "pick more, further apart in depth and towards the picture's corners, or ask for the pose alone"};
}

PoseUncertainty uncertainty_of(const ProjectorFit& fit, double variance_px2) {
  const Eigen::VectorXd variance = fit.covariance.diagonal() * variance_px2;
  PoseUncertainty uncertainty;
  uncertainty.rotation_deg = rad_to_deg * std::sqrt(variance.segment(0, 3).sum());
  uncertainty.position_mm = 1e3 * std::sqrt(variance.segment(3, 3).sum());
  if (fit.unknowns > 6) uncertainty.focal_px = fit.model.focal_px.x * std::sqrt(variance(6));
  if (fit.unknowns > 8) uncertainty.centre_px = std::sqrt(variance.segment(7, 2).sum());
  return uncertainty;
}

}  // namespace

std::string point_label(const Points& points, std::size_t index) {
  const std::string number = std::to_string(index + 1);
  return points[index].name.empty() ? number : number + " (" + points[index].name + ")";
}

Result<ProjectorCalibration> calibrate_by_points(const ProjectorModel& known, const Points& points,
                                                 LensFreedom freedom) {
  if (Status good = check_count(points, freedom); !good) return good.fault();
  if (Status good = check_each(known, points); !good) return good.fault();
  if (Status good = check_spread(points, freedom); !good) return good.fault();
  const auto found = find_consensus(known, points, freedom);
  if (Status good = check_mirror(found, known, points, freedom); !good) return good.fault();
  if (Status good = check_match(found, known); !good) return good.fault();
  if (!found->lying.empty()) return liars(*found, points);
  if (Status good = check_ambiguity(*found, points, freedom); !good) return good.fault();
  const double freedom_left = 2.0 * static_cast<double>(points.size()) - found->fit.unknowns;
  const double variance_px2 = found->fit.square_sum_px2 / freedom_left;
  if (Status good = check_focal(found->fit, variance_px2); !good) return good.fault();
  std::vector<PointResidual> residuals;
  for (std::size_t i = 0; i < points.size(); ++i) {
    residuals.push_back({point_label(points, i), points[i].pixel, found->fit.off_px[i], 0.0, found->left_out_px[i]});
  }
  ProjectorCalibration calibration{found->fit.model, report_of(std::move(residuals), known.width_px, known.height_px)};
  calibration.report.uncertainty = uncertainty_of(found->fit, variance_px2);
  return calibration;
}

}  // namespace focalstage
