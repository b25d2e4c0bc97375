#include "core/percept/seen_frame.h"

#include <utility>

#include "core/schedule/slots.h"

namespace focalstage {

WornGlasses worn_glasses(const Glasses& glasses) { return {shutter_speed(glasses), glasses.lens_aperture_mm / 1000.0}; }

ProjectorFlux flux_of(const Project& project) {
  if (project.projectors.empty()) return {};
  const Projector& projector = project.projectors.front();
  return {projector.lumens.value_or(0.0), exposure_s(projector) * project.sweep.frequency_hz};
}

RetinaInput seen_frame(const Stage& stage, const CompileSettings& settings, const FrameImages& images,
                       const Schedule& schedule, const WornGlasses& glasses, Side side) {
  RetinaInput input;
  input.stage = &stage;
  input.projector = settings.projector;
  input.channels = settings.channels;
  input.bits = settings.bits;
  input.gamma = settings.gamma;
  input.lens_to_pupil_m = settings.lens_to_pupil_m;
  input.lens_aperture_m = glasses.lens_aperture_m;
  if (settings.focus_m > 0.0) input.projector_focus = {1.0 / settings.focus_m, settings.depth_of_field_d};
  for (SeenExposure& seen : seen_exposures(schedule, glasses.shutter, side)) {
    input.exposures.push_back({images.image(static_cast<std::size_t>(seen.image)), std::move(seen.powers), seen.own});
  }
  return input;
}

}  // namespace focalstage
