#pragma once

#include <cstddef>
#include <vector>

#include "core/retina/retina.h"

namespace focalstage {

/// An exposure, or a part of one, as seen through a single power.
struct Pass {
  std::size_t exposure = 0;
  double power_d = 0.0;
  float share = 1.0f;  ///< of the light of a whole exposure
};

/// The exposures cut into as few powers as keep every direction and every blur within half a pixel of the
/// picture: a power changes a direction by no more than the radius of the lens times the change, a blur by the pupil's.
std::vector<Pass> passes_of(const RetinaInput& input, const RetinaView& view);

}  // namespace focalstage
