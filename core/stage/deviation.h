#pragma once

#include <vector>

#include "core/stage/stage.h"

namespace focalstage {

/// How far a thing's surface went when its steps were done, in the room. Distances are those of vertices to the nearest
/// place on the other's triangles.
struct Deviation {
  std::vector<std::vector<double>> of_vertex_m;  ///< of what there is now, per drawable: from what was there before
  double mean_m = 0.0;                           ///< of those
  double worst_m = 0.0;                          ///< what was added, as a filled hole's middle, lies far off
  double worst_lost_m = 0.0;                     ///< the same of what was there before: what went lies far off
};

/// Both have triangles. Vertices that no triangle uses do not count, and have 0.
Deviation deviation_of(const std::vector<Drawable>& before, const std::vector<Drawable>& after);

}  // namespace focalstage
