#include "core/calibrate/align.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "core/calibrate/chance.h"

namespace focalstage {

namespace {

constexpr double thinnest = 0.02;      // root mean square distance from the best line, of that along it
constexpr double mirror_factor = 5.0;  // how much better the mirror image must fit
constexpr double chance = 1e-3;        // of calling a good pair off
constexpr double rounding_mm = 1e-3;   // below this nothing disagrees
constexpr double equations = 3.0;      // that a pair brings
constexpr double unknowns = 6.0;       // of a rigid transform

using Points = Eigen::Matrix3Xd;

Points points_of(const std::vector<PointPair>& pairs, glm::dvec3 PointPair::*side) {
  Points points(3, static_cast<Eigen::Index>(pairs.size()));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const glm::dvec3& p = pairs[i].*side;
    points.col(static_cast<Eigen::Index>(i)) = Eigen::Vector3d(p.x, p.y, p.z);
  }
  return points;
}

Points without(const Points& points, Eigen::Index left_out) {
  Points rest(3, points.cols() - 1);
  rest << points.leftCols(left_out), points.rightCols(points.cols() - left_out - 1);
  return rest;
}

bool collinear(const Points& points) {
  const Points centred = points.colwise() - points.rowwise().mean();
  const Eigen::Vector3d spread = Eigen::JacobiSVD<Eigen::MatrixXd>(centred).singularValues().head<3>();
  return !(std::hypot(spread(1), spread(2)) > thinnest * spread(0));
}

/// World from tracker; `distances_m` of the pairs with it.
struct Fit {
  Eigen::Matrix4d transform;
  Eigen::RowVectorXd distances_m;

  double square_sum() const { return distances_m.squaredNorm(); }
  double rms_m() const { return std::sqrt(square_sum() / static_cast<double>(distances_m.size())); }
};

Eigen::RowVectorXd distances(const Eigen::Matrix4d& transform, const Points& from, const Points& to) {
  const Points moved = (transform.topLeftCorner<3, 3>() * from).colwise() + transform.topRightCorner<3, 1>();
  return (moved - to).colwise().norm();
}

Fit fit(const Points& from, const Points& to) {
  const Eigen::Matrix4d transform = Eigen::umeyama(from, to, false);
  return {transform, distances(transform, from, to)};
}

Rigid rigid_of(const Eigen::Matrix4d& transform) {
  const Eigen::Matrix3d turn = transform.topLeftCorner<3, 3>();
  const Eigen::Quaterniond q = Eigen::Quaterniond(turn).normalized();
  return {{transform(0, 3), transform(1, 3), transform(2, 3)}, glm::dquat(q.w(), q.x(), q.y(), q.z())};
}

Status check_points(const std::vector<PointPair>& pairs) {
  if (pairs.size() < 3) {
    return Fault{"align.few", "pairs", "there are " + std::to_string(pairs.size()) + " pairs of points",
                 "measure three at least, better six, that do not lie on one line"};
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (const glm::dvec3& p : {pairs[i].tracker_m, pairs[i].world_m}) {
      if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
      return Fault{"align.finite", "pair " + pair_label(pairs, i), "a coordinate is no finite number",
                   "measure it anew"};
    }
  }
  return {};
}

Status check_spread(const Points& tracker, const Points& world) {
  for (const auto& [points, name] : {std::pair(&tracker, "tracker"), std::pair(&world, "world")}) {
    if (!collinear(*points)) continue;
    return Fault{"align.collinear", name, "the points lie on one line, or in one place",
                 "measure points beside that line too"};
  }
  return {};
}

Status check_mirror(const Fit& all, const Points& tracker, const Points& world) {
  Points mirrored = tracker;
  mirrored.row(2) *= -1.0;
  const double mirrored_m = fit(mirrored, world).rms_m();
  if (1e3 * all.rms_m() <= rounding_mm || mirror_factor * mirrored_m >= all.rms_m()) return {};
  return Fault{"align.mirrored", "pairs", "the points fit their mirror image: an axis points the wrong way",
               "see which axes tracker and world have; both are right-handed, Y up"};
}

Fault pair_off(const std::vector<PointPair>& pairs, std::size_t index, double off_mm, double rest_rms_mm) {
  char text[160];
  std::snprintf(text, sizeof text, "it is %.1f mm from where the other pairs put it; those agree to %.1f mm", off_mm,
                rest_rms_mm);
  return {"align.pair-off", "pair " + pair_label(pairs, index), text, "measure it anew, or leave it out"};
}

/// Fills in what each pair is off by when the others alone decide, and refuses the one that lies.
Status leave_each_out(const std::vector<PointPair>& pairs, const Fit& all, const Points& tracker, const Points& world,
                      Alignment& alignment) {
  if (pairs.size() < 4) return {};
  const double rest_df = equations * static_cast<double>(pairs.size() - 1) - unknowns;
  double least_chance = 1.0;
  std::size_t suspect = 0;
  double rest_rms_mm = 0.0;
  double square_sum = 0.0;
  int counted = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const Points rest_tracker = without(tracker, column);
    const Points rest_world = without(world, column);
    if (collinear(rest_tracker) || collinear(rest_world)) continue;
    const Fit rest = fit(rest_tracker, rest_world);
    const double off_mm = 1e3 * distances(rest.transform, tracker.col(column), world.col(column))(0);
    alignment.residuals[i].left_out_mm = off_mm;
    square_sum += off_mm * off_mm;
    ++counted;
    const double p =
        off_mm > rounding_mm ? chance_of_gain(all.square_sum(), rest.square_sum(), equations, rest_df) : 1.0;
    if (p >= least_chance) continue;
    least_chance = p;
    suspect = i;
    rest_rms_mm = 1e3 * rest.rms_m();
  }
  if (counted > 0) alignment.left_out_rms_mm = std::sqrt(square_sum / counted);
  if (least_chance * static_cast<double>(pairs.size()) >= chance) return {};
  return pair_off(pairs, suspect, *alignment.residuals[suspect].left_out_mm, rest_rms_mm);
}

}  // namespace

std::string pair_label(const std::vector<PointPair>& pairs, std::size_t index) {
  const std::string number = std::to_string(index + 1);
  return pairs[index].name.empty() ? number : number + " (" + pairs[index].name + ")";
}

Result<Alignment> align(const std::vector<PointPair>& pairs) {
  if (Status good = check_points(pairs); !good) return good.fault();
  const Points tracker = points_of(pairs, &PointPair::tracker_m);
  const Points world = points_of(pairs, &PointPair::world_m);
  if (Status good = check_spread(tracker, world); !good) return good.fault();
  const Fit all = fit(tracker, world);
  if (Status good = check_mirror(all, tracker, world); !good) return good.fault();
  Alignment alignment;
  alignment.world_from_tracker = rigid_of(all.transform);
  alignment.rms_mm = 1e3 * all.rms_m();
  for (const double distance_m : all.distances_m) {
    if (1e3 * distance_m > alignment.worst_mm) alignment.worst = alignment.residuals.size();
    alignment.worst_mm = std::max(alignment.worst_mm, 1e3 * distance_m);
    alignment.residuals.push_back({1e3 * distance_m, std::nullopt});
  }
  if (Status good = leave_each_out(pairs, all, tracker, world, alignment); !good) return good.fault();
  return alignment;
}

}  // namespace focalstage
