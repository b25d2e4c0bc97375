#include "core/schedule/smallest_sweep.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/optics/needs.h"
#include "core/schedule/shown_powers.h"
#include "core/schedule/slots.h"

namespace focalstage {
namespace {

constexpr double tolerance_d = 1e-9;
constexpr double smallest_amplitude_d = 0.05;

double grid_below(double power_d) { return std::floor(power_d * need_cells_per_d + 1e-6) / need_cells_per_d; }
double grid_above(double power_d) { return std::ceil(power_d * need_cells_per_d - 1e-6) / need_cells_per_d; }

}  // namespace

bool sweep_is_free(const Sweep& sweep) { return !sweep.waveform.left && !sweep.waveform.right; }

double usable_share(const Project& project) {
  const double window_s = std::max(project.glasses.shutter_open_ms, project.glasses.shutter_close_ms) / 1000.0;
  const double first_s = (window_s + exposure_s(project.projectors.front())) / 2.0;
  return std::cos(std::min(0.5, project.sweep.frequency_hz * first_s) * 2.0 * std::numbers::pi);
}

std::optional<PowerSpan> smallest_sweep(const Project& project, const PowerSpan& span) {
  const double share = usable_share(project);
  if (!(share > 0.01)) return std::nullopt;
  const double middle_d = (span.low_d + span.high_d) / 2.0;
  const double amplitude_d = std::max((span.high_d - span.low_d) / 2.0 / share, smallest_amplitude_d);
  // Rounded outwards both ends at once, so that neither eats what the other gives.
  const PowerSpan sweep{grid_below(middle_d - amplitude_d), grid_above(middle_d + amplitude_d)};
  const auto& [lens_min_d, lens_max_d] = project.glasses.lens_range_d;
  const PowerSpan within{std::max(sweep.low_d, lens_min_d), std::min(sweep.high_d, lens_max_d)};
  if (within.low_d > middle_d - amplitude_d + tolerance_d || within.high_d < middle_d + amplitude_d - tolerance_d) {
    return std::nullopt;
  }
  return within;
}

std::optional<PowerSpan> reach_of(const Project& project) {
  const PerEye<Result<PowerCurve>> curves = power_curves(project.sweep);
  if (!curves.left || !curves.right) return std::nullopt;
  const double low_d = std::min(curves.left->min_d(), curves.right->min_d());
  const double high_d = std::max(curves.left->max_d(), curves.right->max_d());
  if (!(high_d - low_d <= 2.0 * farthest_need_d)) return std::nullopt;
  std::vector<double> powers_d;
  for (double power_d = grid_above(low_d); power_d <= high_d; power_d += 1.0 / need_cells_per_d)
    powers_d.push_back(power_d);
  const ShownPowers shown(project, powers_d);
  std::optional<PowerSpan> reach;
  for (std::size_t i = 0; i < powers_d.size(); ++i) {
    if (!shown.whole(i)) continue;
    if (!reach) reach = PowerSpan{powers_d[i], powers_d[i]};
    reach->high_d = powers_d[i];
  }
  return reach;
}

}  // namespace focalstage
