#pragma once

#include "core/mesh/mesh.h"

namespace focalstage {

/// Whether the mesh is made of closed parts that are each wound outwards, so that someone outside never has the back of
/// a triangle nearest before him. Cavities and parts turned inside out make it false, which is always the safe answer.
bool is_solid(const Mesh& mesh);

}  // namespace focalstage
