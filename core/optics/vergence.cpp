#include "core/optics/vergence.h"

namespace focalstage {

double needed_power_d(double surface_m, double image_m) { return 1.0 / surface_m - 1.0 / image_m; }

double image_vergence_d(double surface_m, double power_d) { return 1.0 / surface_m - power_d; }

}  // namespace focalstage
