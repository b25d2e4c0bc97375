#pragma once

#include <optional>

#include "editor/tools/sight_frame.h"

namespace focalstage {

/// What lies between two points of the room, as the viewer has it.
struct MeasuredGap {
  double distance_m = 0.0;
  /// How much nearer the first is to the lens centre, as vergence; none where one lies behind the lenses.
  std::optional<double> difference_d;
  double angle_deg = 0.0;  ///< between the lines of sight to them
};

MeasuredGap measured(const SightFrame& sight, const glm::dvec3& a_m, const glm::dvec3& b_m);

}  // namespace focalstage
