#include "core/calibrate/calibration_report.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/number_words.h"

namespace focalstage {

namespace {

constexpr double few_worse = 3.0;  // 95 % of the residuals may be so many limits long

/// The value that so large a share of them does not pass; the mean of two where it falls between.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  const double at = share * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return std::lerp(values[low], values[high], at - static_cast<double>(low));
}

double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Half a hull, from left to right or back (A. M. Andrew, "Another efficient algorithm for convex hulls in two
/// dimensions", 1979).
template <class Iterator>
void half_hull(Iterator begin, Iterator end, std::vector<glm::dvec2>& hull) {
  const std::size_t before = hull.size();
  for (Iterator p = begin; p != end; ++p) {
    while (hull.size() >= before + 2 && cross(hull[hull.size() - 2], hull.back(), *p) <= 0.0) hull.pop_back();
    hull.push_back(*p);
  }
  hull.pop_back();
}

double hull_area(std::vector<glm::dvec2> points) {
  if (points.size() < 3) return 0.0;
  std::ranges::sort(points, [](const auto& a, const auto& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<glm::dvec2> hull;
  half_hull(points.begin(), points.end(), hull);
  half_hull(points.rbegin(), points.rend(), hull);
  double twice = 0.0;
  for (std::size_t i = 0; i + 2 < hull.size(); ++i) twice += cross(hull[0], hull[i + 1], hull[i + 2]);
  return 0.5 * std::abs(twice);
}

Coverage coverage_of(const std::vector<PointResidual>& residuals, int width_px, int height_px) {
  Coverage coverage;
  coverage.counts.assign(static_cast<std::size_t>(Coverage::columns * Coverage::rows), 0);
  std::vector<glm::dvec2> points;
  for (const PointResidual& residual : residuals) {
    points.push_back(residual.pixel);
    const int column =
        std::clamp(static_cast<int>(residual.pixel.x / width_px * Coverage::columns), 0, Coverage::columns - 1);
    const int row = std::clamp(static_cast<int>(residual.pixel.y / height_px * Coverage::rows), 0, Coverage::rows - 1);
    ++coverage.counts[static_cast<std::size_t>(row * Coverage::columns + column)];
  }
  coverage.hull_share = hull_area(std::move(points)) / (static_cast<double>(width_px) * height_px);
  const auto touched = std::ranges::count_if(coverage.counts, [](int count) { return count > 0; });
  coverage.touched_share = static_cast<double>(touched) / static_cast<double>(coverage.counts.size());
  return coverage;
}

}  // namespace

CalibrationReport report_of(std::vector<PointResidual> residuals, int width_px, int height_px) {
  CalibrationReport report;
  report.coverage = coverage_of(residuals, width_px, height_px);
  std::vector<double> distances;
  std::vector<double> left_out;
  for (PointResidual& residual : residuals) {
    residual.distance_px = std::hypot(residual.off_px.x, residual.off_px.y);
    if (residual.distance_px > report.worst_px) report.worst = distances.size();
    report.worst_px = std::max(report.worst_px, residual.distance_px);
    distances.push_back(residual.distance_px);
    if (residual.left_out_px) left_out.push_back(*residual.left_out_px);
  }
  report.median_px = quantile(distances, 0.5);
  report.p95_px = quantile(distances, 0.95);
  if (!left_out.empty()) report.left_out_median_px = quantile(left_out, 0.5);
  report.residuals = std::move(residuals);
  return report;
}

Status check_limit(const CalibrationReport& report, double limit_px) {
  const double left_out = report.left_out_median_px.value_or(0.0);
  if (report.median_px <= limit_px && left_out <= limit_px && report.p95_px <= few_worse * limit_px) return {};
  const std::string worst = report.residuals.empty() ? "" : report.residuals[report.worst].name;
  std::string message = "the residuals' median is " + fixed_text(report.median_px, 2) + " px, 95 % are within " +
                        fixed_text(report.p95_px, 2) + " px";
  if (report.left_out_median_px) message += ", of points left out the median is " + fixed_text(left_out, 2) + " px";
  return Fault{"calibrate.limit", "point " + worst,
               message + "; the limit is " + fixed_text(limit_px, 2) +
                   " px (and three times that for 95 %); this point " + "is off by " + fixed_text(report.worst_px, 2) +
                   " px",
               "measure anew, the worst first; or apply it all the same with --despite-residual"};
}

}  // namespace focalstage
