#include "io/assets/gltf_nodes.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "io/assets/gltf_check.h"

namespace focalstage {
namespace {

constexpr std::size_t most_parts = 65536;  ///< drawn in one scene

glm::dmat4 matrix_from(const std::vector<double>& columns) {
  glm::dmat4 matrix;
  for (int k = 0; k < 16; ++k) matrix[k / 4][k % 4] = columns[static_cast<std::size_t>(k)];
  return matrix;
}

/// Whether no turn and scale has these axes, beyond the rounding of floats.
bool shears(const glm::dmat4& matrix) {
  constexpr double float_rounding = 1e-5;
  for (int a = 0; a < 3; ++a) {
    const glm::dvec3 u(matrix[a]);
    const glm::dvec3 v(matrix[(a + 1) % 3]);
    if (std::abs(glm::dot(u, v)) > float_rounding * glm::length(u) * glm::length(v)) return true;
  }
  return false;
}

NodePose pose_from(const tinygltf::Node& from) {
  NodePose pose;
  if (!from.translation.empty()) pose.translation = {from.translation[0], from.translation[1], from.translation[2]};
  if (!from.scale.empty()) pose.scale = {from.scale[0], from.scale[1], from.scale[2]};
  if (!from.rotation.empty()) {
    pose.rotation = glm::normalize(glm::dquat(from.rotation[3], from.rotation[0], from.rotation[1], from.rotation[2]));
  }
  return pose;
}

class NodeReader {
 public:
  NodeReader(const GltfDocument& document, const std::vector<std::vector<ModelPart>>& parts_of_mesh)
      : document_(document), parts_of_mesh_(parts_of_mesh), parent_(gltf_parents(document.gltf)) {}

  Result<GltfNodes> read() {
    order_nodes();
    mark_scene();
    for (const std::size_t index : order_) {
      if (Status status = add_node(index); !status) return status.fault();
    }
    return std::move(result_);
  }

 private:
  const std::vector<tinygltf::Node>& nodes() const { return document_.gltf.nodes; }

  /// From the roots down, without recursion.
  void order_nodes() {
    result_.node_of_gltf.assign(nodes().size(), -1);
    for (std::size_t i = 0; i < nodes().size(); ++i) {
      if (parent_[i] < 0) order_.push_back(i);
    }
    for (std::size_t at = 0; at < order_.size(); ++at) {
      result_.node_of_gltf[order_[at]] = static_cast<int>(at);
      for (const int child : nodes()[order_[at]].children) order_.push_back(static_cast<std::size_t>(child));
    }
  }

  /// The scene the file names, else its first; every node where it has no scenes.
  void mark_scene() {
    const std::vector<tinygltf::Scene>& scenes = document_.gltf.scenes;
    shown_.assign(nodes().size(), scenes.empty());
    if (!scenes.empty()) {
      const auto chosen = static_cast<std::size_t>(std::max(document_.gltf.defaultScene, 0));
      for (const int root : scenes[chosen].nodes) shown_[static_cast<std::size_t>(root)] = true;
    }
    for (const std::size_t index : order_) {
      if (parent_[index] >= 0) shown_[index] = shown_[static_cast<std::size_t>(parent_[index])];
    }
    if (std::find(shown_.begin(), shown_.end(), false) != shown_.end()) {
      result_.findings.push_back(asset_finding(Severity::info, "asset.scenes", document_.path,
                                               "some nodes are not in the scene that is shown"));
    }
  }

  Status add_node(std::size_t index) {
    const tinygltf::Node& from = nodes()[index];
    Node node;
    node.name = from.name;
    node.parent = parent_[index] < 0 ? -1 : result_.node_of_gltf[static_cast<std::size_t>(parent_[index])];
    node.pose = pose_from(from);
    if (!from.matrix.empty()) {
      node.matrix = matrix_from(from.matrix);
      if (shears(*node.matrix)) {
        result_.findings.push_back(
            asset_finding(Severity::info, "asset.sheared", document_.at("nodes", index) + "/matrix",
                          "the matrix shears, which glTF does not allow; it is drawn as written"));
      }
    }
    if (from.mesh >= 0) add_mesh(from, shown_[index], node);
    parts_ += node.parts.size();
    if (parts_ > most_parts) {
      return Fault{"asset.too-large", document_.path, "the scene draws more than 65536 parts", "join its meshes"};
    }
    result_.nodes.push_back(std::move(node));
    return {};
  }

  /// What the node draws, and how it deforms that: its own weights stand for the mesh's, zeros for none.
  void add_mesh(const tinygltf::Node& from, bool shown, Node& node) const {
    const tinygltf::Mesh& mesh = document_.gltf.meshes[static_cast<std::size_t>(from.mesh)];
    if (shown) node.parts = parts_of_mesh_[static_cast<std::size_t>(from.mesh)];
    node.skin = from.skin;
    node.morph_weights = from.weights.empty() ? mesh.weights : from.weights;
    node.morph_weights.resize(morph_targets(mesh), 0.0);
  }

  const GltfDocument& document_;
  const std::vector<std::vector<ModelPart>>& parts_of_mesh_;
  std::vector<int> parent_;  // these two by the file's index
  std::vector<bool> shown_;
  std::vector<std::size_t> order_;
  std::size_t parts_ = 0;
  GltfNodes result_;
};

}  // namespace

Result<GltfNodes> read_gltf_nodes(const GltfDocument& document,
                                  const std::vector<std::vector<ModelPart>>& parts_of_mesh) {
  return NodeReader(document, parts_of_mesh).read();
}

}  // namespace focalstage
