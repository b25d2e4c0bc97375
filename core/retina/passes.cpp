#include "core/retina/passes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/retina/slice_maps.h"

namespace focalstage {
namespace {

constexpr double tolerance_px = 0.5;
constexpr std::size_t most_parts = 16;

/// Of the powers with any share.
std::pair<double, double> range_of(const std::vector<PowerShare>& powers) {
  double low_d = INFINITY, high_d = -INFINITY;
  for (const PowerShare& part : powers) {
    if (!(part.share > 0.0)) continue;
    low_d = std::min(low_d, part.power_d);
    high_d = std::max(high_d, part.power_d);
  }
  return {low_d, high_d};
}

/// By how many pixels the picture moves or blurs at its worst place for each dioptre of the lens.
double px_per_d(const RetinaInput& input, const RetinaView& view) {
  const glm::dvec2 corner = glm::max(glm::abs(look_of_pixel(view, {0.0, 0.0})),
                                     glm::abs(look_of_pixel(view, {view.width_px, view.height_px})));
  const double off_axis_m = std::min(glm::length(corner) * input.lens_to_pupil_m, input.lens_aperture_m / 2.0);
  return std::max(off_axis_m, view.pupil_m / 2.0) / grid_of(view, 0).step.x;
}

/// Parts `from` to `to` of an exposure as one: their light at their mean power.
Pass together(const std::vector<PowerShare>& powers, std::size_t from, std::size_t to) {
  double share = 0.0, power_d = 0.0;
  for (std::size_t i = from; i < to; ++i) {
    share += powers[i].share;
    power_d += powers[i].share * powers[i].power_d;
  }
  return {0, share > 0.0 ? power_d / share : 0.0, static_cast<float>(share)};
}

/// Adds the passes of one exposure, or of the room's light.
void add_passes(const std::vector<PowerShare>& powers, std::size_t exposure, double each_d, std::vector<Pass>& passes) {
  const auto [low_d, high_d] = range_of(powers);
  if (!(low_d <= high_d)) return;
  const double wanted = std::ceil((high_d - low_d) / each_d);
  const std::size_t parts =
      std::clamp(static_cast<std::size_t>(std::min(wanted, 1e3)), std::size_t{1}, std::min(most_parts, powers.size()));
  for (std::size_t part = 0; part < parts; ++part) {
    Pass pass = together(powers, part * powers.size() / parts, (part + 1) * powers.size() / parts);
    pass.exposure = exposure;
    if (pass.share > 0.0f) passes.push_back(pass);
  }
}

/// A pass stands for half of that to each side.
double each_d(const RetinaInput& input, const RetinaView& view) { return 2.0 * tolerance_px / px_per_d(input, view); }

}  // namespace

std::vector<Pass> passes_of(const RetinaInput& input, const RetinaView& view) {
  std::vector<Pass> passes;
  for (std::size_t i = 0; i < input.exposures.size(); ++i)
    add_passes(input.exposures[i].powers, i, each_d(input, view), passes);
  return passes;
}

std::vector<Pass> ambient_passes_of(const RetinaInput& input, const RetinaView& view) {
  std::vector<Pass> passes;
  add_passes(input.ambient, Pass::ambient, each_d(input, view), passes);
  return passes;
}

}  // namespace focalstage
