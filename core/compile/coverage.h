#pragma once

#include <cstdint>
#include <vector>

#include "core/optics/projector_model.h"
#include "core/stage/stage.h"

namespace focalstage {

/// Of the looks at one object, how many can't be served, both eyes together.
struct ObjectCoverage {
  std::size_t index = 0;  ///< in the project's list
  std::uint64_t looks = 0;
  std::uint64_t off_surface = 0;        ///< no surface behind or before it to carry the picture
  std::uint64_t outside_projector = 0;  ///< the surface is there, the projector does not reach it
  std::uint64_t outside_lens = 0;       ///< the look misses the lens aperture
};

/// Looks from both pupils over a regular grid about as fine as `grid` x `grid` over the objects.
std::vector<ObjectCoverage> measure_coverage(const Stage& stage, const ProjectorModel& projector,
                                             double lens_to_pupil_m, double lens_aperture_m, int grid = 64);

}  // namespace focalstage
