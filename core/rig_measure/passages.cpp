#include "core/rig_measure/passages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include <Eigen/Dense>

namespace focalstage {

namespace {

/// Points of one step of time, gathered.
struct Bin {
  double time_s = 0.0;
  double value = 0.0;
  double count = 0.0;
};

std::vector<Bin> binned(const std::vector<LightPoint>& points, double width_s) {
  std::vector<Bin> bins;
  double until_s = -std::numeric_limits<double>::infinity();
  for (const LightPoint& point : points) {
    if (point.time_s >= until_s) {
      bins.push_back({});
      until_s = point.time_s + width_s;
    }
    Bin& bin = bins.back();
    bin.time_s += point.time_s;
    bin.value += point.value;
    bin.count += 1.0;
  }
  for (Bin& bin : bins) {
    bin.time_s /= bin.count;
    bin.value /= bin.count;
  }
  return bins;
}

/// A parabola through the points around `near_s`; none where it does not cross there.
std::optional<Crossing> crossing_near(const std::vector<LightPoint>& points, double near_s, double half_s,
                                      double level) {
  const auto from = std::ranges::lower_bound(points, near_s - half_s, {}, &LightPoint::time_s);
  const auto to = std::ranges::upper_bound(points, near_s + half_s, {}, &LightPoint::time_s);
  const Eigen::Index count = to - from;
  if (count < 12) return std::nullopt;
  Eigen::MatrixX3d powers(count, 3);
  Eigen::VectorXd values(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double at = (from[i].time_s - near_s) / half_s;
    powers.row(i) << 1.0, at, at * at;
    values[i] = from[i].value - level;
  }
  const Eigen::Matrix3d normal = powers.transpose() * powers;
  const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
  if (!(solver.rcond() > 1e-6)) return std::nullopt;
  const Eigen::Vector3d curve = solver.solve(powers.transpose() * values);
  // Newton's steps from the middle: the curve is nearly straight there.
  double at = 0.0;
  for (int turn = 0; turn < 8; ++turn)
    at -= (curve[0] + (curve[1] + curve[2] * at) * at) / (curve[1] + 2.0 * curve[2] * at);
  if (!(std::abs(at) <= 1.0)) return std::nullopt;
  const double slope = curve[1] + 2.0 * curve[2] * at;
  // How each point moves the crossing, and so how each trace did.
  const Eigen::RowVector3d there(1.0, at, at * at);
  const Eigen::RowVector3d reach = solver.solve(there.transpose()).transpose();
  std::map<int, double> by_trace;
  for (Eigen::Index i = 0; i < count; ++i) {
    by_trace[from[i].trace] += reach.dot(powers.row(i)) * (values[i] - powers.row(i).dot(curve));
  }
  double squares = 0.0;
  for (const auto& [trace, sum] : by_trace) squares += sum * sum;
  const auto traces = static_cast<double>(by_trace.size());
  const double enough = traces > 1.0 ? traces / (traces - 1.0) : 4.0;
  return Crossing{near_s + at * half_s, std::sqrt(enough * squares) * half_s / std::abs(slope), slope > 0.0};
}

}  // namespace

LightRange light_range(const std::vector<LightPoint>& points, double step_s) {
  std::vector<double> values;
  for (const Bin& bin : binned(points, step_s)) values.push_back(bin.value);
  if (values.empty()) return {};
  std::ranges::sort(values);
  return {values[values.size() / 20], values.back()};
}

std::vector<Crossing> crossings(const std::vector<LightPoint>& points, double level, double height, double step_s) {
  const std::vector<Bin> bins = binned(points, 0.5 * step_s);
  const double beyond = 0.1 * height;
  std::vector<Crossing> found;
  int side = 0;
  std::size_t left_at = 0;  // the last bin that was clearly on `side`
  for (std::size_t i = 0; i < bins.size(); ++i) {
    // Where light was missing for longer than between two exposures, nobody knows what happened.
    if (i > 0 && bins[i].time_s - bins[i - 1].time_s > 5.0 * step_s) side = 0;
    const int now = bins[i].value > level + beyond ? 1 : bins[i].value < level - beyond ? -1 : 0;
    if (now == 0) continue;
    if (side != 0 && now != side) {
      const double near_s = 0.5 * (bins[left_at].time_s + bins[i].time_s);
      const double half_s = std::max(4.0 * step_s, 0.6 * (bins[i].time_s - bins[left_at].time_s));
      if (auto crossing = crossing_near(points, near_s, half_s, level)) {
        // Once more, about where it was found.
        if (const auto again = crossing_near(points, crossing->time_s, half_s, level)) crossing = again;
        if (crossing->rises == (now > 0)) found.push_back(*crossing);
      }
    }
    side = now;
    left_at = i;
  }
  return found;
}

}  // namespace focalstage
