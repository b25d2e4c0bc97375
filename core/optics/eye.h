#pragma once

#include "core/base/rigid.h"
#include "core/base/sides.h"

namespace focalstage {

/// One eye behind its lens. The pupil E is the origin of eye space, the gaze its -Z, the lens centre C at
/// (0, 0, -lens_to_pupil_m). Axial distances are measured from C unless a name says otherwise.
struct Eye {
  Rigid eye_from_world;
  double lens_to_pupil_m = 0.015;
};

/// Both eyes, at half the interpupillary distance along the viewer's -X (left) and +X, gazes parallel.
PerEye<Eye> eyes_of(const Rigid& world_from_viewer, double interpupillary_m, double lens_to_pupil_m);

}  // namespace focalstage
