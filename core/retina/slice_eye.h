#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/rigid.h"
#include "core/optics/eye.h"

namespace focalstage {

/// The eye through one power of its lens. A thin lens images the pupil's centre to one point of the axis; all looks of
/// a slice are straight lines from there, so that each slice is a pinhole camera of its own: solved for P, the design's
/// w(P, v) = (P - C) + (1 - v d_p)(C - E) || u says P = C + d_e u + d_p (1 - v d_e) u, a line in d_p through z = d_e^2
/// v / (1 - v d_e) of the axis.
struct SliceEye {
  Rigid slice_from_world;      ///< that point is the origin, the gaze -Z
  double narrowing = 1.0;      ///< 1 - v d_e: a look u of the eye runs along u * narrowing before the lens
  double behind_lens_m = 0.0;  ///< from that point to the lens centre
  double power_d = 0.0;
  double lens_to_pupil_m = 0.0;

  /// Nothing is seen through a lens so strong that its focus lies before the pupil.
  bool sees() const { return narrowing > 0.0; }
};

SliceEye slice_eye(const Eye& eye, double power_d);

}  // namespace focalstage
