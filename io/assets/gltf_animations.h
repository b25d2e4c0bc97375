#pragma once

#include <vector>

#include "core/mesh/model.h"
#include "io/assets/gltf_accessors.h"
#include "io/assets/gltf_nodes.h"

namespace focalstage {

/// A glTF's animations of translation, rotation and scale, on the nodes in our order.
std::vector<Animation> read_gltf_animations(const GltfDocument& document, const GltfNodes& nodes);

}  // namespace focalstage
