#include <algorithm>
#include <cmath>

#include "core/check/candidates.h"
#include "core/check/rules.h"
#include "core/schedule/lens_response.h"

namespace focalstage {
namespace {

constexpr double step_d = 0.05;

/// Dioptres per ampere of one harmonic: as `drive_for_power` has it.
double gain_of(const LensResponse& response, int harmonic) {
  const auto found =
      std::find_if(response.begin(), response.end(), [&](const auto& h) { return h.harmonic == harmonic; });
  return found == response.end() ? LensHarmonic{}.gain_d_per_a : found->gain_d_per_a;
}

/// The largest amplitude of a sine about `middle_d` that a lens bears: its current is m/g0 + A/g1 cos, so that
/// |m|/g0 + A/g1 is its peak and (m/g0)^2 + (A/g1)^2 / 2 its mean square.
double most_amplitude_d(const LensResponse& response, const LensLimits& limits, double middle_d) {
  const double still_a = std::abs(middle_d) / gain_of(response, 0);
  const double square = limits.max_rms_current_a * limits.max_rms_current_a - still_a * still_a;
  if (!(square > 0.0)) return 0.0;
  return gain_of(response, 1) * std::min(limits.max_current_a - still_a, std::sqrt(2.0 * square));
}

/// The sweep's own middle kept; nothing where no sine is borne there.
Edits narrowed(const Project& project) {
  const Sweep& sweep = project.sweep;
  const LensLimits limits = project.glasses.lens_limits.value_or(LensLimits{});
  const double middle_d = (sweep.min_power_d + sweep.max_power_d) / 2.0;
  double amplitude_d = (sweep.max_power_d - sweep.min_power_d) / 2.0;
  for (const Side eye : both_sides) {
    amplitude_d = std::min(amplitude_d, most_amplitude_d(project.glasses.lens_response[eye], limits, middle_d));
  }
  amplitude_d = std::floor(amplitude_d / step_d + rounding) * step_d;
  if (!(amplitude_d > 0.0) || 2.0 * amplitude_d >= sweep.max_power_d - sweep.min_power_d) return {};
  return {set_edit("sweep", "", "min_power_d", middle_d - amplitude_d),
          set_edit("sweep", "", "max_power_d", middle_d + amplitude_d)};
}

}  // namespace

Candidates lens_current_candidates(const Project& project) {
  Candidates candidates = waveform_candidates(project);
  for (Candidate& candidate : candidates) candidate.gives_up = false;  // a sine shows the same slices
  const Edits less = narrowed(project);
  if (less.empty()) return candidates;
  Edits both = candidates.empty() ? Edits{} : candidates.front().edits;
  both.insert(both.end(), less.begin(), less.end());
  candidates.push_back({both});
  return candidates;
}

}  // namespace focalstage
