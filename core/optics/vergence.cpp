#include "core/optics/vergence.h"

namespace focalstage {

double needed_power_d(double surface_m, double image_m) { return 1.0 / surface_m - 1.0 / image_m; }

double image_vergence_d(double surface_m, double power_d) { return 1.0 / surface_m - power_d; }

double vergence_from_pupil_d(double lens_vergence_d, double lens_to_pupil_m) {
  constexpr double between = -1e6;
  const double grown = 1.0 + lens_vergence_d * lens_to_pupil_m;
  return grown > 0.0 ? lens_vergence_d / grown : between;
}

}  // namespace focalstage
