#include "core/retina/slice_eye.h"

namespace focalstage {

SliceEye slice_eye(const Eye& eye, double power_d) {
  SliceEye slice;
  slice.power_d = power_d;
  slice.lens_to_pupil_m = eye.lens_to_pupil_m;
  slice.narrowing = 1.0 - power_d * eye.lens_to_pupil_m;
  slice.slice_from_world = eye.eye_from_world;
  if (!slice.sees()) return slice;
  slice.behind_lens_m = eye.lens_to_pupil_m / slice.narrowing;
  slice.slice_from_world.position_m.z -= slice.behind_lens_m - eye.lens_to_pupil_m;
  return slice;
}

double vergence_at_pupil_d(double vergence_at_lens_d, double lens_to_pupil_m) {
  const double grown = 1.0 + vergence_at_lens_d * lens_to_pupil_m;
  return grown > 0.0 ? vergence_at_lens_d / grown : -most_vergence_d;
}

double vergence_at_lens_d(double vergence_at_pupil_d, double lens_to_pupil_m) {
  const double shrunk = 1.0 - vergence_at_pupil_d * lens_to_pupil_m;
  return shrunk > 0.0 ? vergence_at_pupil_d / shrunk : most_vergence_d;
}

}  // namespace focalstage
