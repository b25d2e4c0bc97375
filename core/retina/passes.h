#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "core/retina/retina.h"

namespace focalstage {

/// An exposure, or a part of one, as seen through a single power.
struct Pass {
  static constexpr std::size_t ambient = std::numeric_limits<std::size_t>::max();

  bool is_ambient() const { return exposure == ambient; }

  std::size_t exposure = 0;  ///< or `ambient`: the room's light
  double power_d = 0.0;
  float share = 1.0f;  ///< of the light of a whole exposure
};

/// The exposures cut into as few powers as keep every direction and every blur within half a pixel of the
/// picture: a power changes a direction by no more than the radius of the lens times the change, a blur by the pupil's.
std::vector<Pass> passes_of(const RetinaInput& input, const RetinaView& view);

/// The same of the room's light.
std::vector<Pass> ambient_passes_of(const RetinaInput& input, const RetinaView& view);

}  // namespace focalstage
