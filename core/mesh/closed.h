#pragma once

#include "core/mesh/mesh.h"

namespace focalstage {

/// Whether the mesh bounds a solid: every edge has one triangle on each side, wound alike, so that from outside nobody
/// ever sees the back of a triangle. Vertices at the same place count as one (a seam of UVs does not open a mesh).
bool is_closed(const Mesh& mesh);

}  // namespace focalstage
