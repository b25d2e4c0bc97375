#include "core/rig_measure/light_edge.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/rig_measure/rising.h"

namespace focalstage {

namespace {

/// The samples of one trace that lie around the rise, as shares of the plateau behind it.
struct Rise {
  std::size_t first = 0;
  std::size_t last = 0;
  double plateau = 0.0;
};

double most_of(const LightTraces& traces) {
  double most = 0.0;
  for (const LightTrace& trace : traces) {
    for (const double value : trace.light) most = std::max(most, value);
  }
  return most;
}

std::optional<Rise> rise_in(const LightTrace& trace, double dark, double half, double exposure_s) {
  const auto up = std::ranges::find_if(trace.light, [&](double value) { return value > half; });
  const auto reach = static_cast<std::ptrdiff_t>(0.4 * exposure_s / trace.step_s);
  if (reach < 3 || up - trace.light.begin() < reach || trace.light.end() - up <= reach) return std::nullopt;
  Rise rise;
  rise.first = static_cast<std::size_t>(up - trace.light.begin() - reach);
  rise.last = static_cast<std::size_t>(up - trace.light.begin() + reach);
  double sum = 0.0;
  for (auto it = up + 2; it <= up + reach; ++it) sum += *it - dark;
  rise.plateau = sum / static_cast<double>(reach - 1);
  return rise;
}

Fault none_seen() {
  return {"measure.latency", "projector", "no exposure was seen to begin after its trigger",
          "see that the sensor looks at what the projector lights, and that the trigger line reaches it"};
}

}  // namespace

Result<LightEdge> light_edge(const LightTraces& traces, const DarkLight& dark, double trigger_s, double exposure_s) {
  if (saturated_share(traces) > 0.001) {
    return Fault{"measure.saturated", "projector", "the light sensor stands at the end of its range",
                 "give it less light: a smaller gain, a denser filter"};
  }
  const double half = dark.level + 0.5 * (most_of(traces) - dark.level);
  if (half < dark.level + 4.0 * dark.noise) return none_seen();
  std::vector<double> middles_s;
  std::vector<LightPoint> points;
  for (std::size_t k = 0; k < traces.size(); ++k) {
    const LightTrace& trace = traces[k];
    const std::optional<Rise> rise = rise_in(trace, dark.level, half, exposure_s);
    if (!rise) continue;
    double sum = 0.0;
    for (std::size_t i = rise->first; i <= rise->last; ++i) {
      const double share = (trace.light[i] - dark.level) / rise->plateau;
      sum += share;
      points.push_back({trace.time_s(i), share, static_cast<int>(k)});
    }
    // Each sample stands for half a step either side.
    middles_s.push_back(trace.time_s(rise->last) + (0.5 - sum) * trace.step_s);
  }
  if (middles_s.size() < 4 || 2 * middles_s.size() < traces.size()) return none_seen();
  double mean_s = 0.0;
  for (const double middle_s : middles_s) mean_s += middle_s / static_cast<double>(middles_s.size());
  double squares = 0.0;
  for (const double middle_s : middles_s) squares += (middle_s - mean_s) * (middle_s - mean_s);
  const auto count = static_cast<double>(middles_s.size());
  const double repeats_s = std::sqrt(squares / (count * (count - 1.0)));
  std::ranges::stable_sort(points, {}, &LightPoint::time_s);
  const RisingCurve curve = rising_curve(points);
  const double rise_s = curve.passing_s(0.9) - curve.passing_s(0.1);
  LightEdge edge;
  edge.latency_ms = {1e3 * (mean_s - trigger_s), 1e3 * std::hypot(repeats_s, 0.5 * rise_s)};
  edge.rise_ms = {1e3 * rise_s, 1e3 * std::hypot(repeats_s, traces.front().step_s / std::sqrt(12.0 * count))};
  if (edge.latency_ms.value < -edge.latency_ms.spread) return none_seen();
  return edge;
}

}  // namespace focalstage
