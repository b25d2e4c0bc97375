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

}  // namespace focalstage
