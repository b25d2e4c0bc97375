#include "core/optics/eye.h"

namespace focalstage {

PerEye<Eye> eyes_of(const Rigid& world_from_viewer, double interpupillary_m, double lens_to_pupil_m) {
  const auto eye = [&](double x_m) {
    const Rigid viewer_from_eye{{x_m, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
    return Eye{(world_from_viewer * viewer_from_eye).inverse(), lens_to_pupil_m};
  };
  return {eye(-interpupillary_m / 2.0), eye(interpupillary_m / 2.0)};
}

}  // namespace focalstage
