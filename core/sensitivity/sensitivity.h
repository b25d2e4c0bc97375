#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/mesh/model.h"
#include "core/scene/project.h"
#include "core/sensitivity/rig_errors.h"

namespace focalstage {

/// What an error does to what is seen: the worst over all objects' points, both eyes and the frames looked at.
struct ErrorEffect {
  RigError error;
  double shift_arcmin = 0.0;  ///< a point is seen so far from where the object's point is
  double focus_d = 0.0;       ///< and comes into focus so far from where it is meant to, beside what it is off without
  double vergence_d = 0.0;    ///< and the eyes converge so far from it
  std::string object;         ///< whose point is shifted most; empty: no point of any object is seen
};

/// Follows light as it is compiled (from a point of an object to the projector's pixel, by design section 5) and then
/// through the rig as it really is: out of that pixel to the surface where it really stands, through the real lens into
/// the real pupil. The slice is the nearest to what the point needs. Looks at `frames` frames, spread over the show.
///
/// Faults of the stage, and "reference.embree".
Result<std::vector<ErrorEffect>> sensitivity(const Project& project, const Assets& assets, int frames = 3);

}  // namespace focalstage
