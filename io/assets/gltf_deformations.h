#pragma once

#include <map>
#include <memory>
#include <vector>

#include "core/mesh/model.h"
#include "io/assets/gltf_accessors.h"
#include "io/assets/mesh_file.h"

namespace focalstage {

/// How a glTF's primitives deform. Those with the same morph targets and joints are given the same value.
class GltfDeformations {
 public:
  explicit GltfDeformations(const GltfDocument& document) : document_(document) {}

  /// Null where nothing moves the primitive's vertices. Fault "asset.too-large".
  Result<std::shared_ptr<const Deformation>> of(const tinygltf::Primitive& primitive, const std::string& where);

  const std::vector<Finding>& findings() const { return findings_; }

 private:
  /// The accessors it is made of: of each morph target the offsets of positions and normals (-1: none), of each set of
  /// joints these and their weights.
  struct Sources {
    std::vector<int> targets;
    std::vector<int> joints;

    auto operator<=>(const Sources&) const = default;
  };

  Sources find_sources(const tinygltf::Primitive& primitive, const std::string& where);
  Status take(const Sources& sources, std::size_t vertices, const std::string& where);
  MorphTarget read_target(int offsets, int normal_offsets, std::size_t vertices) const;
  void read_shares(const Sources& sources, const std::string& where, Deformation& deformation);

  const GltfDocument& document_;
  std::vector<Finding> findings_;
  std::map<Sources, std::shared_ptr<const Deformation>> known_;
  std::size_t values_ = 0;
};

/// A glTF's skins, their joints among the nodes in our order.
std::vector<Skin> read_gltf_skins(const GltfDocument& document, const std::vector<int>& node_of_gltf);

}  // namespace focalstage
