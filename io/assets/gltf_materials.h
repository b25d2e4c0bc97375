#pragma once

#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include <glm/vec2.hpp>

#include "core/mesh/model.h"
#include "io/assets/gltf_accessors.h"
#include "io/assets/mesh_file.h"

namespace focalstage {

/// Where on a mesh a material's texture lies.
struct TextureLayout {
  int uv_set = -1;         ///< the TEXCOORD_n; -1 without texture
  glm::dvec2 offset{0.0};  ///< KHR_texture_transform: in glTF's UV, whose origin is the upper left corner
  double rotation = 0.0;   ///< radians, counter-clockwise as seen
  glm::dvec2 scale{1.0};

  /// From glTF's UV to ours, whose origin is the lower left corner.
  glm::dvec2 uv_from(const glm::dvec2& gltf_uv) const;
};

/// A glTF's materials as far as they are drawn.
struct GltfMaterials {
  std::vector<Material> materials;
  std::vector<TextureLayout> layouts;  ///< of each material's texture
  std::vector<bool> invisible;         ///< of each material: MASK cuts all of it away
  std::vector<Finding> findings;
};

/// The layout that a texture has in the file. The file's JSON has been checked for its shape.
TextureLayout texture_layout(const tinygltf::TextureInfo& texture);

Result<GltfMaterials> read_gltf_materials(const GltfDocument& document);

}  // namespace focalstage
