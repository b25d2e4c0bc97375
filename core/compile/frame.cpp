#include "core/compile/frame.h"

#include <algorithm>
#include <cmath>

#include "core/optics/light_levels.h"

namespace focalstage {
namespace {

std::vector<BlendProjector> blend_of(const Project& project) {
  const std::vector<double> levels = light_levels(project);
  std::vector<BlendProjector> all;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const Projector& one = project.projectors[i];
    all.push_back({projector_model(one), one.blend_margin_px, one.black_level, levels[i],
                   reference_m(one, project.slices.compensation)});
  }
  return all;
}

}  // namespace

CompileSettings compile_settings(const Project& project, std::size_t projector_index) {
  const Projector& projector = project.projectors.at(projector_index);
  CompileSettings settings;
  settings.projector = projector_model(projector);
  settings.channels = projector.color == ColorMode::rgb ? 3 : 1;
  settings.bits = projector.bits;
  settings.gamma = projector.gamma;
  settings.transfer = projector.transfer;
  settings.black_level = projector.black_level;
  settings.lens_to_pupil_m = project.glasses.lens_to_pupil_mm / 1000.0;
  settings.focus_m = projector.focus_m.value_or(0.0);
  settings.depth_of_field_d = projector.depth_of_field_d.value_or(0.0);
  settings.reference_m = reference_m(projector, project.slices.compensation);
  settings.slices = project.slices;
  settings.images = image_plan(project);
  settings.blend_own = projector_index;
  if (project.projectors.size() > 1) settings.blend = blend_of(project);
  return settings;
}

std::vector<ProjectorModel> projectors_of(const CompileSettings& settings) {
  if (settings.blend.empty()) return {settings.projector};
  std::vector<ProjectorModel> models;
  for (const BlendProjector& one : settings.blend) models.push_back(one.model);
  return models;
}

OptimalMeasure operator+(const OptimalMeasure& a, const OptimalMeasure& b) {
  return {a.tiles + b.tiles,   a.accepted_tiles + b.accepted_tiles, a.left_tiles + b.left_tiles,
          a.values + b.values, a.linear_error + b.linear_error,     a.optimal_error + b.optimal_error};
}

double psnr_db(const OptimalMeasure& measure, double error) {
  constexpr double least = 1e-12;  // no error at all counts as 120 dB
  if (measure.values == 0) return 0.0;
  return -10.0 * std::log10(std::max(least, error / static_cast<double>(measure.values)));
}

double gain_db(const OptimalMeasure& measure) {
  return psnr_db(measure, measure.optimal_error) - psnr_db(measure, measure.linear_error);
}

}  // namespace focalstage
