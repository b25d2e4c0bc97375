#pragma once

#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "core/mesh/model.h"
#include "io/assets/gltf_accessors.h"
#include "io/assets/mesh_file.h"

namespace focalstage {

/// A glTF's materials as far as they are drawn: base colour and texture, unlit or not.
struct GltfMaterials {
  std::vector<Material> materials;
  std::vector<int> uv_set;  ///< of each material: the TEXCOORD_n its texture is laid out on; -1 without texture
  std::vector<Finding> findings;
};

Result<GltfMaterials> read_gltf_materials(const GltfDocument& document);

}  // namespace focalstage
