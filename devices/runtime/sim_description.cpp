#include "devices/runtime/sim_description.h"

#include "core/schedule/sweep_shape.h"

namespace focalstage {

namespace {

// As far as a shaped sweep goes (core/schedule/sweep_shape.h).
constexpr int harmonics = most_shaped_harmonics;

LensResponse response_of(const SimLensSettings& lens, double frequency_hz) {
  LensResponse response;
  for (int n = 0; n <= harmonics; ++n) {
    const LensPoint point = lens_point(lens, n * frequency_hz);
    response.push_back({n, point.gain_d_per_a, n == 0 ? 0.0 : point.phase_deg, {}});
  }
  return response;
}

}  // namespace

RigDescription describe_sim(const SimSettings& sim, const RigLimits& limits, double frequency_hz) {
  RigDescription rig;
  rig.name = "simulated rig";
  rig.kind = "sim";
  Projector projector;
  projector.name = "main";
  projector.model = "dynaflash";
  projector.width_px = sim.width_px;
  projector.height_px = sim.height_px;
  projector.frames_per_second = 1.0 / sim.projector.least_frame_s;
  projector.latency_ms = sim.projector.latency_s * 1000.0;
  rig.projectors.push_back(projector);
  rig.glasses.shutter_open_ms = sim.shutter.open_s * 1000.0;
  rig.glasses.shutter_close_ms = sim.shutter.close_s * 1000.0;
  for (const Side eye : both_sides) rig.glasses.lens_response[eye] = response_of(sim.lens[eye], frequency_hz);
  rig.frequency_hz = frequency_hz;
  rig.lens_current_max_a = limits.lens_current_max_a;
  rig.shutter_changes_per_s_max = limits.shutter_changes_per_s_max;
  return rig;
}

}  // namespace focalstage
