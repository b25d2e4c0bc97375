#include "core/rig_measure/shutter_time.h"

#include <algorithm>
#include <cmath>

#include "core/base/number_words.h"
#include "core/rig_measure/rising.h"

namespace focalstage {

namespace {

constexpr int groups = 8;
constexpr double nothing_seen = 0.03;    // of the range: noise and hum
constexpr double most_leak = 0.2;        // of the open light, through a closed shutter
constexpr double least_open = 0.85;      // of the reference, through an open one
constexpr double most_unsettled = 0.03;  // change between the last two eighths of what was seen

Fault trouble(const std::string& where, const std::string& message, const std::string& remedy) {
  return {"measure.shutter", where, message, remedy};
}

double mean_between(const std::vector<LightPoint>& points, double from_s, double to_s) {
  double sum = 0.0;
  double count = 0.0;
  for (const LightPoint& point : points) {
    if (point.time_s < from_s || point.time_s > to_s) continue;
    sum += point.value;
    count += 1.0;
  }
  return sum / count;
}

/// Where it was before and is afterwards.
struct Levels {
  double before = 0.0;
  double after = 0.0;
};

Result<Levels> levels_of(const std::vector<LightPoint>& shares, const ShutterChange& change, double from_s,
                         const std::string& where) {
  const double span_s = change.until_s - change.told_s;
  const Levels levels{mean_between(shares, from_s, change.told_s),
                      mean_between(shares, change.until_s - span_s / 8.0, change.until_s)};
  const double earlier = mean_between(shares, change.until_s - span_s / 4.0, change.until_s - span_s / 8.0);
  const double open = change.opens ? levels.after : levels.before;
  const double closed = change.opens ? levels.before : levels.after;
  if (!std::isfinite(open) || !std::isfinite(closed) || !std::isfinite(earlier)) {
    return Fault{"measure.light", where, "no light was seen around the change", "look at the projector"};
  }
  if (!(closed < most_leak)) {
    return trouble(where, "closed, it lets " + short_text(100.0 * closed, 3) + " % of the light through",
                   "see that the sensor sees nothing past the shutter, and that the shutter has its voltage");
  }
  if (!(open > least_open)) {
    return trouble(where, "open, it reaches " + short_text(100.0 * open, 3) + " % of its light only",
                   "measure at a lower sweep frequency: it is slower than this one leaves it");
  }
  if (std::abs(levels.after - earlier) > most_unsettled) {
    return trouble(where, "it still moves where the measuring ends", "measure at a lower sweep frequency");
  }
  return levels;
}

/// Share of the way, in time order, without one of the groups of traces (or with all).
std::vector<LightPoint> way(const std::vector<LightPoint>& shares, const Levels& levels, double from_s, double until_s,
                            int without) {
  std::vector<LightPoint> points;
  for (const LightPoint& point : shares) {
    if (point.time_s < from_s || point.time_s > until_s || point.trace % groups == without) continue;
    points.push_back({point.time_s, (point.value - levels.before) / (levels.after - levels.before), point.trace});
  }
  return points;
}

struct Run {
  double early_s = 0.0;  ///< 10 %
  double late_s = 0.0;   ///< 90 %
  double end_s = 0.0;
};

/// Where a straight line through the points around `near_s` passes `level`. A rising curve passes it where the few
/// points at hand say so, and their traces may differ by hum; so many that each trace is among them say it better.
double passing_near_s(const std::vector<LightPoint>& points, double level, double near_s, double half_s) {
  const auto from = std::ranges::lower_bound(points, near_s - half_s, {}, &LightPoint::time_s);
  const auto to = std::ranges::upper_bound(points, near_s + half_s, {}, &LightPoint::time_s);
  double n = 0.0, t = 0.0, v = 0.0, tt = 0.0, tv = 0.0;
  for (auto point = from; point != to; ++point) {
    const double at_s = point->time_s - near_s;
    n += 1.0;
    t += at_s;
    v += point->value;
    tt += at_s * at_s;
    tv += at_s * point->value;
  }
  const double slope = (tv - t * v / n) / (tt - t * t / n);
  const double off_s = (level - (v - slope * t) / n) / slope;
  return slope > 0.0 && std::abs(off_s) < half_s ? near_s + off_s : near_s;
}

Run run_of(const std::vector<LightPoint>& points, double step_s) {
  const RisingCurve curve = rising_curve(points);
  Run run{curve.passing_s(0.1), curve.passing_s(0.9), 0.0};
  // As far to both sides as a straight run stays straight; of a quick one that is less than a sample or two.
  const double half_s = 0.08 * (run.late_s - run.early_s);
  if (half_s > 2.0 * step_s) {
    run.early_s = passing_near_s(points, 0.1, run.early_s, half_s);
    run.late_s = passing_near_s(points, 0.9, run.late_s, half_s);
  }
  run.end_s = std::max(run.late_s + (run.late_s - run.early_s) / 8.0, curve.passing_s(0.98));
  return run;
}

/// Between which points a moment lies: where the light had a gap it is known no better.
double gap_at(const std::vector<LightPoint>& points, double time_s) {
  const auto after = std::ranges::upper_bound(points, time_s, {}, &LightPoint::time_s);
  if (after == points.begin() || after == points.end()) return 0.0;
  return after->time_s - (after - 1)->time_s;
}

}  // namespace

Result<Estimate> shutter_time_ms(const std::vector<LightPoint>& shares, const ShutterChange& change,
                                 const ShutterLook& look, const std::string& where) {
  const double before_s = change.told_s - 0.1 * (change.until_s - change.told_s);
  const Result<Levels> levels = levels_of(shares, change, before_s, where);
  if (!levels) return levels.fault();
  const std::vector<LightPoint> all = way(shares, *levels, before_s, change.until_s, -1);
  const Run run = run_of(all, look.step_s);
  double squares = 0.0;
  double mean = 0.0;
  std::vector<double> parts;
  for (int group = 0; group < groups; ++group) {
    parts.push_back(run_of(way(shares, *levels, before_s, change.until_s, group), look.step_s).end_s);
    mean += parts.back() / groups;
  }
  for (const double part : parts) squares += (part - mean) * (part - mean);
  const double repeats_s = std::sqrt(squares * (groups - 1) / groups);
  // The shifted traces see between each other's samples: what is left is a part of a step, and gaps in the light.
  const double grid_s = look.step_s / 8.0;
  const double gaps_s = std::hypot(gap_at(all, run.early_s), gap_at(all, run.late_s)) / std::sqrt(12.0);
  // Before, after and in between: three levels, each as well known as the next.
  const double level_s = std::sqrt(3.0) * look.level_spread * (run.late_s - run.early_s) / 0.8;
  const double known_s = std::hypot(grid_s, gaps_s, std::hypot(level_s, look.delay_spread_s));
  return Estimate{1e3 * (run.end_s - change.told_s), 1e3 * std::hypot(repeats_s, known_s)};
}

Status own_side(double own_swing, double other_swing, const std::string& where) {
  if (other_swing < nothing_seen) return {};
  if (other_swing > 3.0 * own_swing) {
    return Fault{"measure.swapped", where, "the sensor of the other eye answers to this shutter",
                 "swap the two sensors, or the two shutters' lines"};
  }
  if (other_swing > 0.3 * own_swing) {
    return Fault{"measure.leak", where, "the sensors of both eyes answer to this shutter",
                 "keep light from passing beside the glasses"};
  }
  return {};
}

}  // namespace focalstage
