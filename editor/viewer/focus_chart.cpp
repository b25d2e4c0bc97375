#include "editor/viewer/focus_chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>

namespace focalstage {
namespace {

constexpr double most_moved_d = 0.4;
constexpr double step_d = 0.05;
constexpr double least_moved_d = 0.25;  ///< to either side: less leaves too little to compare
constexpr double chart_wide_deg = 4.0;
constexpr double chart_high_deg = 2.0;
constexpr double middle_deg = 1.4;        ///< of a chart, above or below the gaze
constexpr double finest_deg = 0.1;        ///< pairs of lines an eye with 20/20 still sees blur in: ten cycles a degree
constexpr double line_pair_px = 4.0;      ///< the finest that a projector draws with even contrast
constexpr double chart_distance_m = 1.0;  ///< pinned to a slice, it is free
constexpr double picture_deg = 8.0;
constexpr double slant_rad = 0.2;  ///< of the lines, so that all places among the projector's pixels are as frequent
constexpr double inside = 0.6;     ///< of a chart, where it is read

double degrees(double tangent) { return std::atan(tangent) * 180.0 / std::numbers::pi; }

Object chart(const FocusCharts& charts, const EyeInRoom& eye, const std::string& name, double sign, std::size_t slice) {
  const int lines = 2 * static_cast<int>(std::lround(chart_wide_deg / charts.line_deg));
  Object object = slice_object(
      name, PlaneMesh{{chart_distance_m * tangent_deg(chart_wide_deg), chart_distance_m * tangent_deg(chart_high_deg)}},
      slice);
  CheckerAppearance stripes;
  stripes.squares = {lines, 1};
  object.appearance = stripes;
  const glm::dvec3 place_m{0.0, sign * chart_distance_m * tangent_deg(middle_deg), -chart_distance_m};
  const glm::dquat slant = glm::angleAxis(slant_rad, glm::dvec3(0.0, 0.0, 1.0));
  object.placement.pose = {eye.world_from_eye.point(place_m), eye.world_from_eye.rotation * slant};
  return object;
}

Result<Source> charts_moved(const Source& from, const FocusCharts& charts, const EyeInRoom& eye, double moved_d) {
  Project project = bare_room(from.project, "Lens power", 1);
  project.slices.powers_d = {charts.power_d + moved_d - chart_apart_d, charts.power_d + moved_d + chart_apart_d};
  project.objects = {chart(charts, eye, "lower", -1.0, 0), chart(charts, eye, "upper", 1.0, 1)};
  return pattern_source(from, std::move(project), {});
}

/// Mean and mean square of light.
struct LightMoments {
  double count = 0.0, sum = 0.0, squares = 0.0;

  void take(double light) {
    count += 1.0;
    sum += light;
    squares += light * light;
  }
  double contrast() const {
    const double mean = sum / count;
    return std::sqrt(std::max(0.0, squares / count - mean * mean)) / mean;
  }
};

}  // namespace

Result<FocusCharts> focus_charts(const Source& from, Side side, double focus_m) {
  const auto eye = EyeInRoom::of(from, side);
  if (!eye) return eye.fault();
  const auto surface_m = eye->flat_surface_m(middle_deg + chart_high_deg);
  if (!surface_m) return surface_m.fault();
  const auto pixel_m = eye->pixel_m({0.0, 0.0, -*surface_m});
  if (!pixel_m) return pixel_m.fault();
  FocusCharts charts;
  charts.eye = side;
  charts.surface_m = *surface_m;
  charts.focus_d = 1.0 / focus_m;
  charts.power_d = 1.0 / (*surface_m - from.project.glasses.lens_to_pupil_mm * 1e-3) - charts.focus_d;
  charts.line_deg = std::max(finest_deg, degrees(line_pair_px * *pixel_m / *surface_m));
  const int steps = static_cast<int>(std::lround(most_moved_d / step_d));
  for (int k = -steps; k <= steps; ++k) {
    auto source = charts_moved(from, charts, *eye, k * step_d);
    if (!source) return source.fault();
    charts.moved_d.push_back(k * step_d);
    charts.sources.push_back(*std::move(source));
  }
  return charts;
}

Result<TwoChoiceTest> chart_test(const FocusCharts& charts, const std::filesystem::path& folder,
                                 const FrameProgress& progress, const std::stop_token& stop) {
  TwoChoiceTest test;
  std::string why = "the sweep does not reach it";
  for (std::size_t k = 0; k < charts.sources.size(); ++k) {
    progress(static_cast<int>(k), static_cast<int>(charts.sources.size()));
    const auto ready = make_pattern_show(
        charts.sources[k], folder / ("chart-" + std::to_string(k) + ".h5"), [](int, int) {}, stop);
    if (!ready && ready.fault().code != "viewer.unreachable") return ready.fault();
    if (!ready) {
      why = ready.fault().message;
      continue;
    }
    test.levels.push_back(charts.moved_d[k]);
    test.stimuli.push_back({test.shows.size(), ready->targets.front()});
    test.shows.push_back(*ready);
  }
  // Moved to more power than is asked for, the lower chart is the one that lies nearer to the power in focus.
  test.above = Choice::second;
  const bool wide = !test.levels.empty() && test.levels.front() < -least_moved_d + step_d / 2.0 &&
                    test.levels.back() > least_moved_d - step_d / 2.0;
  if (wide) return test;
  char what[96];
  std::snprintf(what, sizeof what, "an eye focused at %.2f D asks for %.2f D here: ", charts.focus_d, charts.power_d);
  return Fault{"viewer.unreachable", "/sweep", what + why,
               "choose --focus-m so that the power lies 0.6 D within the sweep and its shutters"};
}

Result<double> seen_chart_difference(const ShowReader& show, const TrueEye& eye) {
  const auto seen = see_pattern(show, 0, eye, picture_deg);
  if (!seen) return seen.fault();
  LightMoments upper, lower;
  seen->each([&](const glm::dvec2& look, double light) {
    const bool within =
        std::abs(look.x) < inside * tangent_deg(chart_wide_deg) / 2.0 &&
        std::abs(std::abs(look.y) - tangent_deg(middle_deg)) < inside * tangent_deg(chart_high_deg) / 2.0;
    if (within) (look.y > 0.0 ? upper : lower).take(light);
  });
  if (!(upper.sum > 0.0) || !(lower.sum > 0.0)) return nothing_seen(0, "a chart");
  return std::log(upper.contrast() / lower.contrast());
}

TrueEye eye_at_charts(const FocusCharts& charts, double power_error_d) {
  TrueEye eye;
  eye.side = charts.eye;
  eye.focus_d = charts.focus_d;
  eye.power_error_d = power_error_d;
  return eye;
}

LensPowerCheck lens_power_check(const FocusCharts& charts, const EqualityEstimate& found, double focus_uncertainty_d) {
  LensPowerCheck check;
  check.asked_d = charts.power_d;
  // Where the charts are equal the true power between them is the one in focus: moved + asked + error = asked.
  check.error_d = -found.value;
  check.answers_d = found.uncertainty;
  check.focus_d = focus_uncertainty_d;
  check.uncertainty_d = std::hypot(found.uncertainty, focus_uncertainty_d);
  check.differs = std::abs(check.error_d) > 2.0 * check.uncertainty_d;
  return check;
}

}  // namespace focalstage
