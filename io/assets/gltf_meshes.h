#pragma once

#include <vector>

#include "core/mesh/model.h"
#include "io/assets/gltf_accessors.h"
#include "io/assets/gltf_materials.h"
#include "io/assets/mesh_file.h"

namespace focalstage {

/// A glTF's meshes, each the parts that a node with it draws. Primitives of the same data are one mesh.
struct GltfMeshes {
  std::vector<std::vector<ModelPart>> parts_of_mesh;
  std::size_t vertices = 0;  ///< of all meshes, shared data once
  std::size_t triangles = 0;
  std::vector<Finding> findings;
};

Result<GltfMeshes> read_gltf_meshes(const GltfDocument& document, const GltfMaterials& materials);

}  // namespace focalstage
