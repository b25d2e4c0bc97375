#pragma once

#include <cstddef>
#include <vector>

#include "core/optics/projector_model.h"
#include "core/stage/stage.h"

namespace focalstage {

/// What a projector's light falls on of one surface.
struct LitSurface {
  std::size_t index = 0;       ///< in the project's list
  double share = 0.0;          ///< of the projector's picture
  double albedo = 0.0;         ///< mean luminance of what comes back of white light
  double pixels_per_m2 = 0.0;  ///< mean density of the projector's pixels on it
};

/// Of every surface that the projector reaches, in the stage's order; sampled at about `grid` x `grid` places.
std::vector<LitSurface> lit_surfaces(const Stage& stage, const ProjectorModel& projector, int grid = 96);

}  // namespace focalstage
