#pragma once

#include <stop_token>

#include "core/base/result.h"
#include "core/retina/retina.h"

namespace focalstage {

// What one eye sees, by following rays: out of the retina, through the pupil and the thin lens at a moment of the
// exposure, to the first surface, and on to the projector's pixel that lights it. Slow, and nothing in it but the
// lens: what core/retina does fast is held against it.

struct RayCount {
  int per_pixel = 64;  ///< for each exposure; spread over the pixel, the pupil, the exposure and the projector's blur
  int threads = 0;     ///< 0: all
};

/// The same picture as Retina::view. Each ray has its own place in the pixel, the pupil and the exposure (a Halton
/// sequence, turned by a hash of the pixel), so that the same call gives the same picture and a pixel's error falls
/// nearly as 1 / per_pixel. Faults: those of Retina::view, "reference.rays", "reference.embree".
Result<RetinaImage> see_by_rays(const RetinaInput& input, const RetinaView& view, const RayCount& rays,
                                std::stop_token stop = {});

}  // namespace focalstage
