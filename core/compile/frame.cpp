#include "core/compile/frame.h"

namespace focalstage {

CompileSettings compile_settings(const Project& project, std::size_t projector_index) {
  const Projector& projector = project.projectors.at(projector_index);
  CompileSettings settings;
  settings.projector = projector_model(projector);
  settings.channels = projector.color == ColorMode::rgb ? 3 : 1;
  settings.bits = projector.bits;
  settings.gamma = projector.gamma;
  settings.lens_to_pupil_m = project.glasses.lens_to_pupil_mm / 1000.0;
  settings.focus_m = projector.focus_m.value_or(0.0);
  settings.depth_of_field_d = projector.depth_of_field_d.value_or(0.0);
  settings.slices = project.slices;
  settings.images = image_plan(project);
  return settings;
}

}  // namespace focalstage
