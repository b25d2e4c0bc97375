#pragma once

#include <cstddef>
#include <vector>

#include "core/mesh/measure.h"
#include "editor/tools/handle_frame.h"

namespace focalstage {

enum class AlignTo { low, middle, high };

/// Something to align and the box around it in the world.
struct Aligned {
  HandleThing thing;
  Bounds bounds;
};

/// All moved along one world axis (0 x, 1 y, 2 z) until that end of their bounds is level with the last one's. Things
/// without bounds count as points.
std::vector<HandleThing> aligned(const std::vector<Aligned>& things, std::size_t axis, AlignTo to);

/// All moved along their lines of sight until they are as far from the viewer as the last.
std::vector<HandleThing> at_same_distance(const std::vector<HandleThing>& things, const Rigid& world_from_viewer);

}  // namespace focalstage
