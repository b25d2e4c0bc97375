#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check/candidates.h"
#include "core/check/rules.h"
#include "core/schedule/slots.h"

namespace focalstage {
namespace {

constexpr double step_d = 0.25;

double step_up(double power_d) { return std::ceil(power_d / step_d - rounding) * step_d; }
double step_down(double power_d) { return std::floor(power_d / step_d + rounding) * step_d; }

bool lit(const Surface& surface) { return !surface.hidden && surface.illumination > 0.0; }

/// The part of a sine's amplitude that the exposures can use: cos of the phase from an extremum to the centre of the
/// first exposure that clears the dead window.
double usable_share(const Project& project) {
  const double window_s = std::max(project.glasses.shutter_open_ms, project.glasses.shutter_close_ms) / 1000.0;
  const double first_s = (window_s + exposure_s(project.projectors.front())) / 2.0;
  return std::cos(std::min(0.5, project.sweep.frequency_hz * first_s) * 2.0 * std::numbers::pi);
}

Edits sweep_edits(const Sweep& sweep, double min_d, double max_d) {
  Edits edits;
  if (min_d != sweep.min_power_d) edits.push_back(set_edit("sweep", "", "min_power_d", min_d));
  if (max_d != sweep.max_power_d) edits.push_back(set_edit("sweep", "", "max_power_d", max_d));
  return edits;
}

}  // namespace

Edit set_edit(const std::string& list, const std::string& name, const std::string& key, Value value) {
  return {Edit::Kind::set, list, name, key, std::move(value)};
}

std::optional<Edits> widen_sweep(const Project& project, double low_d, double high_d) {
  const Sweep& sweep = project.sweep;
  const auto& [lens_min_d, lens_max_d] = project.glasses.lens_range_d;
  if (project.projectors.empty() || (sweep.waveform.left && sweep.waveform.right)) return std::nullopt;
  const double share = usable_share(project);
  if (!(share > 0.01)) return std::nullopt;

  // With m the middle, A the amplitude and c the usable share: m - c A <= low and m + c A >= high, solved for one
  // extreme given the other. Taken in turns from the present sweep, both grow to the least pair that serves.
  double min_d = sweep.min_power_d;
  double max_d = sweep.max_power_d;
  for (bool grown = true; grown;) {
    const double need_max_d = (2.0 * high_d - min_d * (1.0 - share)) / (1.0 + share);
    const double need_min_d = (2.0 * low_d - max_d * (1.0 - share)) / (1.0 + share);
    if (need_max_d > lens_max_d + rounding || need_min_d < lens_min_d - rounding) return std::nullopt;
    const double next_max_d = need_max_d > max_d ? std::min(step_up(need_max_d), lens_max_d) : max_d;
    const double next_min_d = need_min_d < min_d ? std::max(step_down(need_min_d), lens_min_d) : min_d;
    grown = next_max_d > max_d || next_min_d < min_d;
    max_d = next_max_d;
    min_d = next_min_d;
  }
  Edits edits = sweep_edits(sweep, min_d, max_d);
  if (edits.empty()) return std::nullopt;
  return edits;
}

Candidates sweep_candidates(const Project& project, double low_d, double high_d) {
  double lowest_d = low_d;
  double highest_d = high_d;
  for (const double power_d : project.slices.powers_d) {
    lowest_d = std::min(lowest_d, power_d);
    highest_d = std::max(highest_d, power_d);
  }
  if (std::any_of(project.surfaces.begin(), project.surfaces.end(), lit)) {
    lowest_d = std::min(lowest_d, 0.0);
    highest_d = std::max(highest_d, 0.0);
  }
  Candidates candidates;
  if (const auto all = widen_sweep(project, lowest_d, highest_d)) candidates.push_back({*all});
  if (const auto own = widen_sweep(project, low_d, high_d)) candidates.push_back({*own});
  return candidates;
}

Candidates no_zero_crossing_candidates(const Project& project) {
  Candidates candidates = sweep_candidates(project, 0.0, 0.0);
  Edits dark;
  for (const Surface& surface : project.surfaces) {
    if (lit(surface)) dark.push_back(set_edit("surfaces", surface.name, "illumination", 0.0));
  }
  candidates.push_back({dark, true});
  return candidates;
}

Candidates lens_range_candidates(const Project& project, const Finding& finding) {
  const auto& [lens_min_d, lens_max_d] = project.glasses.lens_range_d;
  Candidates candidates;
  const double min_d = std::clamp(project.sweep.min_power_d, lens_min_d, lens_max_d);
  const double max_d = std::clamp(project.sweep.max_power_d, lens_min_d, lens_max_d);
  const Edits clamped = sweep_edits(project.sweep, min_d, max_d);
  if (!clamped.empty()) candidates.push_back({clamped});

  // Slices that the lens cannot reach, or that a clamped sweep cannot show.
  const double share = project.projectors.empty() ? 1.0 : usable_share(project);
  const double reach_d = (max_d - min_d) / 2.0 * share;
  std::vector<std::size_t> beyond;
  for (std::size_t i = 0; i < project.slices.powers_d.size(); ++i) {
    if (std::abs(project.slices.powers_d[i] - (min_d + max_d) / 2.0) > reach_d) beyond.push_back(i);
  }
  if (const auto own = slice_of(project, finding)) {
    if (const auto dropped = drop_slices(project, {*own})) candidates.push_back({*dropped, true});
  }
  if (const auto dropped = drop_slices(project, beyond)) {
    Edits both = clamped;
    both.insert(both.end(), dropped->begin(), dropped->end());
    candidates.push_back({both, true});
  }
  return candidates;
}

Candidates waveform_candidates(const Project& project) {
  if (!project.sweep.waveform.left && !project.sweep.waveform.right) return {};
  return {{{set_edit("sweep", "", "waveform", "sine")}, true}};
}

Candidates frame_rate_candidates(const Project& project, const Finding& finding) {
  const double sweeps = std::max(1.0, std::round(project.sweep.frequency_hz / project.frames.rate_hz));
  if (!finding.amount) return {};
  return {{{set_edit("frames", "", "rate_hz", project.sweep.frequency_hz / sweeps)}}};
}

Candidates flicker_candidates(const Project& project) {
  // A measured period holds at its own frequency only.
  if (project.sweep.waveform.left || project.sweep.waveform.right) return {};
  const double rate_hz = project.frames.rate_hz;
  const double least_hz = std::ceil(slowest_sweep_hz / rate_hz - rounding) * rate_hz;
  Candidates candidates;
  if (std::isfinite(least_hz)) candidates.push_back({{set_edit("sweep", "", "frequency_hz", least_hz)}});
  for (const double sweep_hz : {60.0, slowest_sweep_hz}) {
    const double sweeps = std::max(1.0, std::round(sweep_hz / rate_hz));
    candidates.push_back(
        {{set_edit("sweep", "", "frequency_hz", sweep_hz), set_edit("frames", "", "rate_hz", sweep_hz / sweeps)}});
  }
  return candidates;
}

}  // namespace focalstage
