#pragma once

#include <array>
#include <vector>

#include "editor/tools/sight_frame.h"

namespace focalstage {

/// Where the picture of the main surface stands for the viewer through one slice's power.
struct SliceSheet {
  std::size_t slice = 0;  ///< in the project's list
  double power_d = 0.0;
  double vergence_d = 0.0;              ///< 1/d_p - power; 0 or less: at infinity and beyond
  bool drawn = false;                   ///< near enough to be drawn in the room
  std::array<glm::dvec3, 4> corners_m;  ///< as far as the surface is seen; only where drawn
};

/// One per slice, in the project's order; empty without a surface before the viewer. Sheets farther than four times the
/// surface are not drawn: in the room they would be nowhere.
std::vector<SliceSheet> slice_sheets(const Project& project, const Stage& stage, Picker& picker);

}  // namespace focalstage
