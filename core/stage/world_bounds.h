#pragma once

#include <vector>

#include "core/mesh/measure.h"
#include "core/stage/stage.h"

namespace focalstage {

/// Around everything the drawables hold, in the world.
Bounds world_bounds(const std::vector<Drawable>& drawables);

}  // namespace focalstage
