#pragma once

#include <vector>

#include "core/mesh/model.h"
#include "io/assets/gltf_accessors.h"
#include "io/assets/mesh_file.h"

namespace focalstage {

/// A glTF's nodes, parents before children. All are kept, those outside the scene that is shown without their meshes.
struct GltfNodes {
  std::vector<Node> nodes;
  std::vector<int> node_of_gltf;  ///< by the file's index
  std::vector<Finding> findings;
};

Result<GltfNodes> read_gltf_nodes(const GltfDocument& document,
                                  const std::vector<std::vector<ModelPart>>& parts_of_mesh);

}  // namespace focalstage
