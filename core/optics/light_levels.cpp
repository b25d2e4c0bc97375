#include "core/optics/light_levels.h"

#include <algorithm>

#include "core/optics/pixel_density.h"

namespace focalstage {
namespace {

/// Lumen seconds per square metre of one exposure.
double full_white(const Projector& projector, const Compensation& compensation) {
  const double exposure_s = projector.exposure_ms ? *projector.exposure_ms / 1000.0 : 1.0 / projector.frames_per_second;
  const double pixels = static_cast<double>(projector.width_px) * projector.height_px;
  return *projector.lumens / pixels * exposure_s *
         pixels_per_m2_on_axis(projector_model(projector), reference_m(projector, compensation));
}

}  // namespace

double reference_m(const Projector& projector, const Compensation& compensation) {
  return compensation.reference_m.value_or(projector.focus_m.value_or(1.0));
}

std::vector<double> light_levels(const Project& project) {
  const std::vector<Projector>& projectors = project.projectors;
  std::vector<double> levels(projectors.size(), 1.0);
  const bool known =
      std::all_of(projectors.begin(), projectors.end(), [](const Projector& p) { return p.lumens.has_value(); });
  if (!known || projectors.size() < 2) return levels;
  for (std::size_t i = 0; i < levels.size(); ++i) levels[i] = full_white(projectors[i], project.slices.compensation);
  const double least = *std::min_element(levels.begin(), levels.end());
  for (double& level : levels) level /= least;
  return levels;
}

}  // namespace focalstage
