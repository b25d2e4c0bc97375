#pragma once

#include <memory>

#include "core/base/result.h"
#include "core/mesh/mesh.h"
#include "core/scene/project.h"

namespace focalstage {

/// The mesh of a primitive, the same one for the same shape as long as it is among the last 64 asked for. Any thread.
/// Code "stage.mesh-size", with the key of the wrong number as the place.
Result<std::shared_ptr<const Mesh>> primitive_mesh(const MeshShape& shape);

}  // namespace focalstage
