#include "core/rig_measure/light_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/base/number_words.h"

namespace focalstage {

namespace {

// What stands this near the end of the range may have been cut.
constexpr double full_scale = 0.995;
constexpr double most_saturated = 0.001;
// Light that is to be measured: of the range, and over the noise of one sample.
constexpr double least_swing = 0.03;
constexpr double least_over_noise = 8.0;
// Hum in step with the sweep does not go away by averaging.
constexpr double most_steady_hum = 0.03;
// Samples are gathered this often per step: between each other's, as far as the traces are shifted.
constexpr double bins_per_step = 2.0;
// Of full light: what still counts as lit, and how much it may differ between gathered samples next to each other.
constexpr double least_lit = 0.3;
constexpr double most_uneven = 0.15;

struct Bins {
  double first_s = 0.0;
  double width_s = 0.0;
  std::vector<double> mean;  ///< NaN where nothing fell

  double middle_s(std::size_t i) const { return first_s + (static_cast<double>(i) + 0.5) * width_s; }
};

Bins binned(const LightTraces& traces, double width_s) {
  double from_s = std::numeric_limits<double>::infinity();
  double to_s = -from_s;
  for (const LightTrace& trace : traces) {
    if (trace.light.empty()) continue;
    from_s = std::min(from_s, trace.first_s);
    to_s = std::max(to_s, trace.time_s(trace.light.size() - 1));
  }
  Bins bins{from_s, width_s, {}};
  if (!(to_s >= from_s)) return bins;
  const std::size_t count = static_cast<std::size_t>((to_s - from_s) / width_s) + 1;
  std::vector<double> sum(count, 0.0);
  std::vector<double> number(count, 0.0);
  for (const LightTrace& trace : traces) {
    for (std::size_t i = 0; i < trace.light.size(); ++i) {
      const auto bin = std::min(count - 1, static_cast<std::size_t>((trace.time_s(i) - from_s) / width_s));
      sum[bin] += trace.light[i];
      number[bin] += 1.0;
    }
  }
  for (std::size_t i = 0; i < count; ++i) bins.mean.push_back(sum[i] / number[i]);
  return bins;
}

double step_of(const LightTraces& traces) { return traces.empty() ? 0.0 : traces.front().step_s; }

std::size_t samples_of(const LightTraces& traces) {
  std::size_t count = 0;
  for (const LightTrace& trace : traces) count += trace.light.size();
  return count;
}

Fault nothing_seen(const std::string& where) {
  return {"measure.light", where, "the light sensor delivered no samples", "look at its cable and its state"};
}

Fault saturated(const std::string& where) {
  return {"measure.saturated", where, "the light sensor stands at the end of its range",
          "give it less light: a smaller gain, a denser filter, less ambient light"};
}

std::string percent(double share) { return short_text(100.0 * share, 3) + " %"; }

}  // namespace

double saturated_share(const LightTraces& traces) {
  std::size_t cut = 0;
  for (const LightTrace& trace : traces) {
    cut += static_cast<std::size_t>(std::ranges::count_if(trace.light, [](double v) { return v >= full_scale; }));
  }
  const std::size_t all = samples_of(traces);
  return all == 0 ? 0.0 : static_cast<double>(cut) / static_cast<double>(all);
}

Result<DarkLight> dark_light(const LightTraces& dark) {
  const std::size_t count = samples_of(dark);
  if (count == 0) return nothing_seen("dark");
  if (saturated_share(dark) > most_saturated) return saturated("dark");
  double sum = 0.0;
  for (const LightTrace& trace : dark) {
    for (const double value : trace.light) sum += value;
  }
  DarkLight found;
  found.level = sum / static_cast<double>(count);
  double squares = 0.0;
  for (const LightTrace& trace : dark) {
    for (const double value : trace.light) squares += (value - found.level) * (value - found.level);
  }
  found.noise = std::sqrt(squares / static_cast<double>(count));
  // What is the same in all traces: their mean over time, as far as its swing is more than chance would make it.
  const Bins bins = binned(dark, 8.0 * step_of(dark));
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const double mean : bins.mean) {
    if (std::isnan(mean)) continue;
    least = std::min(least, mean);
    most = std::max(most, mean);
  }
  const double per_bin = static_cast<double>(count) / static_cast<double>(bins.mean.size());
  const double by_chance = 2.5 * found.noise / std::sqrt(std::max(1.0, per_bin / 8.0));
  found.steady = std::max(0.0, 0.5 * (most - least) - by_chance);
  return found;
}

Result<FullLight> FullLight::make(const LightTraces& lit, const DarkLight& dark, const std::string& where) {
  if (samples_of(lit) == 0) return nothing_seen(where);
  if (saturated_share(lit) > most_saturated) return saturated(where);
  FullLight full;
  full.dark_ = dark.level;
  full.step_s_ = step_of(lit);
  const Bins bins = binned(lit, full.step_s_ / bins_per_step);
  full.first_s_ = bins.first_s;
  std::vector<double> sorted;
  for (std::size_t i = 0; i < bins.mean.size(); ++i) {
    full.times_.push_back(bins.middle_s(i));
    full.light_.push_back(bins.mean[i] - dark.level);
    if (!std::isnan(bins.mean[i])) sorted.push_back(full.light_.back());
  }
  // The brightest tenth, without its outliers.
  const auto high = sorted.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(sorted.size() - 1));
  std::ranges::nth_element(sorted, high);
  full.swing_ = *high;
  if (full.swing_ < least_swing || full.swing_ < least_over_noise * dark.noise / 4.0) {
    return Fault{"measure.light", where,
                 "the light of the projector moves the sensor by " + percent(full.swing_) +
                     " of its range only, over a noise of " + percent(dark.noise),
                 "see that the sensor looks at what the projector lights, or raise its gain"};
  }
  if (dark.steady > most_steady_hum * full.swing_ || dark.noise * least_over_noise / 2.0 > full.swing_) {
    return Fault{"measure.hum", where,
                 "without the projector's light the sensor swings by " + percent(dark.steady) +
                     " in step with the sweep and by " + percent(dark.noise) + " besides, against a signal of " +
                     percent(full.swing_),
                 "turn off lamps on mains, shield the sensor's cable"};
  }
  full.level_spread_ = dark.noise / full.swing_ / std::sqrt(static_cast<double>(lit.size()));
  return full;
}

/// None outside of the light, and where it changes faster than the gathered samples can follow: next to the beginning
/// and the end of an exposure.
std::optional<double> FullLight::at(double time_s) const {
  const double place = (time_s - first_s_) * bins_per_step / step_s_ - 0.5;
  const auto below = static_cast<std::ptrdiff_t>(std::floor(place));
  if (below < 1 || below + 2 >= static_cast<std::ptrdiff_t>(light_.size())) return std::nullopt;
  const auto around = std::span(light_).subspan(static_cast<std::size_t>(below - 1), 4);
  double least = around[0];
  double most = around[0];
  for (const double light : around) {
    if (std::isnan(light)) return std::nullopt;
    least = std::min(least, light);
    most = std::max(most, light);
  }
  if (least < least_lit * swing_ || most - least > most_uneven * most) return std::nullopt;
  return std::lerp(around[1], around[2], place - std::floor(place));
}

std::vector<LightPoint> FullLight::shares(const LightTraces& traces) const {
  std::vector<LightPoint> points;
  for (std::size_t k = 0; k < traces.size(); ++k) {
    const LightTrace& trace = traces[k];
    for (std::size_t i = 0; i < trace.light.size(); ++i) {
      const std::optional<double> full = at(trace.time_s(i));
      if (full) points.push_back({trace.time_s(i), (trace.light[i] - dark_) / *full, static_cast<int>(k)});
    }
  }
  std::ranges::stable_sort(points, {}, &LightPoint::time_s);
  return points;
}

}  // namespace focalstage
