#include "core/percept/seen_frame.h"

#include <utility>

#include "core/base/periodic.h"
#include "core/optics/pixel_density.h"
#include "core/percept/lit_surfaces.h"
#include "core/schedule/slots.h"

namespace focalstage {

WornGlasses worn_glasses(const Glasses& glasses) { return {shutter_speed(glasses), glasses.lens_aperture_mm / 1000.0}; }

ProjectorFlux flux_of(const Project& project) {
  if (project.projectors.empty()) return {};
  const Projector& projector = project.projectors.front();
  return {projector.lumens.value_or(0.0), exposure_s(projector) * project.sweep.frequency_hz};
}

RoomLight room_light_of(const Project& project) { return {project.ambient_lux, flux_of(project)}; }

std::vector<PowerShare> ambient_shares(const Schedule& schedule, const WornGlasses& glasses, Side side,
                                       const RoomLight& room, double white_lux) {
  constexpr int parts = 256;  // of the period
  std::vector<PowerShare> shares;
  if (!(room.ambient_lux > 0.0) || !(white_lux > 0.0) || schedule.lens_power_d[side].empty()) return shares;
  const ShutterCurve shutter(schedule.shutter[side], glasses.shutter, schedule.period_s);
  const double per_part = room.ambient_lux / (white_lux * room.flux.exposure_share * parts);
  for (int part = 0; part < parts; ++part) {
    const double turns = (part + 0.5) / parts;
    const double open = shutter.transmission(turns * schedule.period_s);
    if (open > 0.0) shares.push_back({periodic_at(schedule.lens_power_d[side], turns), open * per_part});
  }
  return shares;
}

namespace {

/// What full white is on the reference: where light counts as 1, or on average on all that the projector reaches.
double reference_lux(const Stage& stage, const CompileSettings& settings, const RetinaInput& input,
                     const ProjectorFlux& flux) {
  const ProjectorModel& projector = settings.projector;
  double per_m2 = 0.0;
  if (input.falloff_reference_m) {
    per_m2 = pixels_per_m2_on_axis(projector, *input.falloff_reference_m);
  } else {
    double share = 0.0;
    for (const LitSurface& surface : lit_surfaces(stage, projector)) {
      per_m2 += surface.share * surface.pixels_per_m2;
      share += surface.share;
    }
    per_m2 = share > 0.0 ? per_m2 / share : 0.0;
  }
  return flux.lumens / (static_cast<double>(projector.width_px) * projector.height_px) * per_m2;
}

}  // namespace

RetinaInput seen_frame(const Stage& stage, const CompileSettings& settings, const FrameImages& images,
                       const Schedule& schedule, const WornGlasses& glasses, Side side, const RoomLight& room) {
  RetinaInput input;
  input.stage = &stage;
  input.projector = settings.projector;
  input.channels = settings.channels;
  input.bits = settings.bits;
  input.gamma = settings.gamma;
  input.transfer = settings.transfer;
  input.black_level = settings.black_level;
  if (settings.slices.compensation.mode == CompensationMode::even) {
    input.falloff_reference_m = settings.reference_m;
    if (!settings.blend.empty()) input.level = settings.blend.at(settings.blend_own).level;
  }
  if (room.ambient_lux > 0.0) {
    input.ambient = ambient_shares(schedule, glasses, side, room, reference_lux(stage, settings, input, room.flux));
  }
  input.lens_to_pupil_m = settings.lens_to_pupil_m;
  input.lens_aperture_m = glasses.lens_aperture_m;
  if (settings.focus_m > 0.0) input.projector_focus = {1.0 / settings.focus_m, settings.depth_of_field_d};
  for (SeenExposure& seen : seen_exposures(schedule, glasses.shutter, side)) {
    input.exposures.push_back({images.image(static_cast<std::size_t>(seen.image)), std::move(seen.powers), seen.own});
  }
  return input;
}

}  // namespace focalstage
