#pragma once

#include <cstddef>
#include <vector>

#include "core/percept/lit_surfaces.h"
#include "core/scene/project.h"
#include "core/schedule/schedule.h"

namespace focalstage {

/// How bright white and black are on one surface to an eye (that which has it worse), in full codes of a whole exposure
/// there (docs/colour.md). What the surface returns falls out of their ratio.
struct SurfaceContrast {
  std::size_t index = 0;      ///< in the project's list
  int exposures = 0;          ///< of a period that reach the eye
  double leak = 0.0;          ///< black of all of them
  double ambient = 0.0;       ///< the room's light while the shutter is open
  bool knows_ambient = true;  ///< false: there is some, and the projector's brightness is not known
  double white_cd_m2 = 0.0;   ///< full white in one exposure, with all that leaks; 0 where the brightness is not known

  double white = 1.0;  ///< full white in one exposure, black in the others, and the room's light

  double black() const { return leak + ambient; }
  /// White over black; infinite where nothing leaks.
  double ratio() const;
};

/// Of the surfaces lit; `schedule`: as the project's exposures are timed.
std::vector<SurfaceContrast> contrasts_of(const Project& project, const Schedule& schedule,
                                          const std::vector<LitSurface>& surfaces);

}  // namespace focalstage
