#pragma once

#include <memory>
#include <vector>

#include "core/mesh/measure.h"
#include "core/stage/stage.h"

namespace focalstage {

/// mesh_bounds, measured once for each mesh while it lives: views ask every frame.
const Bounds& known_bounds(const std::shared_ptr<const Mesh>& mesh);

/// Around the corners of each mesh's own box as it stands in the world: a little more than world_bounds where a thing
/// is turned, and as cheap for a million triangles as for two.
Bounds rough_world_bounds(const std::vector<Drawable>& drawables);

}  // namespace focalstage
