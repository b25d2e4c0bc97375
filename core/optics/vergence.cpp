#include "core/optics/vergence.h"

namespace focalstage {

double needed_power_d(double surface_m, double image_m) { return 1.0 / surface_m - 1.0 / image_m; }

double image_vergence_d(double surface_m, double power_d) { return 1.0 / surface_m - power_d; }

double wanted_vergence_d(const Depth& depth, double placed_m) {
  if (depth.mode == DepthMode::fixed) return depth.vergence_d;
  return 1.0 / placed_m + (depth.mode == DepthMode::offset ? depth.vergence_d : 0.0);
}

double vergence_at_pupil_d(double at_lens_d, double lens_to_pupil_m) {
  const double grown = 1.0 + at_lens_d * lens_to_pupil_m;
  return grown > 0.0 ? at_lens_d / grown : -most_vergence_d;
}

double vergence_at_lens_d(double at_pupil_d, double lens_to_pupil_m) {
  const double shrunk = 1.0 - at_pupil_d * lens_to_pupil_m;
  return shrunk > 0.0 ? at_pupil_d / shrunk : most_vergence_d;
}

}  // namespace focalstage
