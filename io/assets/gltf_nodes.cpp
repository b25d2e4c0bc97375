#include "io/assets/gltf_nodes.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace focalstage {
namespace {

constexpr std::size_t most_parts = 65536;  ///< drawn in one scene

bool all_finite(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); });
}

/// Translation, rotation and scale whose product the matrix is, within the rounding of floats; none for a sheared or
/// flat one.
bool decompose(const std::vector<double>& columns, NodePose& pose) {
  glm::dmat3 turned;
  for (int c = 0; c < 3; ++c) {
    const auto at = static_cast<std::size_t>(4 * c);
    turned[c] = {columns[at], columns[at + 1], columns[at + 2]};
    if (columns[at + 3] != 0.0) return false;
    pose.scale[c] = glm::length(turned[c]);
    if (!(pose.scale[c] > 1e-12) || !std::isfinite(pose.scale[c])) return false;
    turned[c] /= pose.scale[c];
  }
  if (columns[15] != 1.0) return false;
  constexpr double float_rounding = 1e-5;
  if (std::abs(glm::dot(turned[0], turned[1])) > float_rounding ||
      std::abs(glm::dot(turned[1], turned[2])) > float_rounding ||
      std::abs(glm::dot(turned[2], turned[0])) > float_rounding) {
    return false;
  }
  if (glm::determinant(turned) < 0.0) {
    pose.scale.x = -pose.scale.x;
    turned[0] = -turned[0];
  }
  pose.translation = {columns[12], columns[13], columns[14]};
  pose.rotation = glm::normalize(glm::quat_cast(turned));
  return true;
}

class NodeReader {
 public:
  NodeReader(const GltfDocument& document, const std::vector<std::vector<ModelPart>>& parts_of_mesh)
      : document_(document), parts_of_mesh_(parts_of_mesh), parent_(document.gltf.nodes.size(), -1) {}

  Result<GltfNodes> read() {
    for (const auto part : {&NodeReader::find_parents, &NodeReader::order_nodes, &NodeReader::mark_scene}) {
      if (Status status = (this->*part)(); !status) return status.fault();
    }
    for (const std::size_t index : order_) {
      if (Status status = add_node(index); !status) return status.fault();
    }
    return std::move(result_);
  }

 private:
  const std::vector<tinygltf::Node>& nodes() const { return document_.gltf.nodes; }

  bool has_node(int index) const { return index >= 0 && static_cast<std::size_t>(index) < nodes().size(); }

  Status find_parents() {
    for (std::size_t i = 0; i < nodes().size(); ++i) {
      for (const int child : nodes()[i].children) {
        const std::string where = document_.at("nodes", i) + "/children";
        if (!has_node(child)) return invalid_asset(where, "there is no such node");
        int& parent = parent_[static_cast<std::size_t>(child)];
        if (parent >= 0) return invalid_asset(where, "node " + std::to_string(child) + " has two parents");
        parent = static_cast<int>(i);
      }
    }
    return {};
  }

  /// From the roots down, without recursion. With one parent at most, whoever is not reached stands in a circle.
  Status order_nodes() {
    result_.node_of_gltf.assign(nodes().size(), -1);
    for (std::size_t i = 0; i < nodes().size(); ++i) {
      if (parent_[i] < 0) order_.push_back(i);
    }
    for (std::size_t at = 0; at < order_.size(); ++at) {
      result_.node_of_gltf[order_[at]] = static_cast<int>(at);
      for (const int child : nodes()[order_[at]].children) order_.push_back(static_cast<std::size_t>(child));
    }
    if (order_.size() == nodes().size()) return {};
    const auto lost = std::find(result_.node_of_gltf.begin(), result_.node_of_gltf.end(), -1);
    return invalid_asset(document_.at("nodes", static_cast<std::size_t>(lost - result_.node_of_gltf.begin())),
                         "the node is among its own ancestors");
  }

  /// The scene the file names, else its first; every node where it has no scenes.
  Status mark_scene() {
    const std::vector<tinygltf::Scene>& scenes = document_.gltf.scenes;
    shown_.assign(nodes().size(), scenes.empty());
    const int chosen = std::max(document_.gltf.defaultScene, 0);
    if (document_.gltf.defaultScene >= static_cast<int>(scenes.size())) {
      return invalid_asset(document_.path + ": /scene", "there is no such scene");
    }
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      for (const int root : scenes[i].nodes) {
        const std::string where = document_.at("scenes", i) + "/nodes";
        if (!has_node(root)) return invalid_asset(where, "there is no such node");
        if (parent_[static_cast<std::size_t>(root)] >= 0) return invalid_asset(where, "a scene's node has a parent");
        if (static_cast<int>(i) == chosen) shown_[static_cast<std::size_t>(root)] = true;
      }
    }
    bool all = true;
    for (const std::size_t index : order_) {
      if (parent_[index] >= 0) shown_[index] = shown_[static_cast<std::size_t>(parent_[index])];
      all = all && shown_[index];
    }
    if (!all) {
      result_.findings.push_back(asset_finding(Severity::info, "asset.scenes", document_.path,
                                               "some nodes are not in the scene that is shown"));
    }
    return {};
  }

  Status add_node(std::size_t index) {
    const tinygltf::Node& from = nodes()[index];
    const std::string where = document_.at("nodes", index);
    if (!from.weights.empty())
      return unsupported_asset(where, "morph targets are not read", "export without shape keys");
    Node node;
    node.name = from.name;
    node.parent = parent_[index] < 0 ? -1 : result_.node_of_gltf[static_cast<std::size_t>(parent_[index])];
    if (Status status = read_pose(from, where, node.pose); !status) return status;
    if (from.mesh >= static_cast<int>(parts_of_mesh_.size())) {
      return invalid_asset(where + "/mesh", "there is no such mesh");
    }
    if (from.mesh >= 0 && shown_[index]) node.parts = parts_of_mesh_[static_cast<std::size_t>(from.mesh)];
    parts_ += node.parts.size();
    if (parts_ > most_parts) {
      return Fault{"asset.too-large", document_.path, "the scene draws more than 65536 parts", "join its meshes"};
    }
    result_.nodes.push_back(std::move(node));
    return {};
  }

  static Status read_pose(const tinygltf::Node& from, const std::string& where, NodePose& pose) {
    const auto has = [](const std::vector<double>& numbers, std::size_t count) {
      return numbers.empty() || (numbers.size() == count && all_finite(numbers));
    };
    if (!has(from.matrix, 16) || !has(from.translation, 3) || !has(from.rotation, 4) || !has(from.scale, 3)) {
      return invalid_asset(where, "its pose has the wrong count of numbers");
    }
    if (!from.matrix.empty() && !decompose(from.matrix, pose)) {
      return unsupported_asset(where + "/matrix", "the matrix shears or flattens", "apply the transform to the mesh");
    }
    if (!from.translation.empty()) pose.translation = {from.translation[0], from.translation[1], from.translation[2]};
    if (!from.scale.empty()) pose.scale = {from.scale[0], from.scale[1], from.scale[2]};
    if (from.rotation.empty()) return {};
    const glm::dquat rotation(from.rotation[3], from.rotation[0], from.rotation[1], from.rotation[2]);
    constexpr double tolerance = 0.01;
    if (std::abs(glm::length(rotation) - 1.0) > tolerance) {
      return invalid_asset(where + "/rotation", "the quaternion is not of unit length");
    }
    pose.rotation = glm::normalize(rotation);
    return {};
  }

  const GltfDocument& document_;
  const std::vector<std::vector<ModelPart>>& parts_of_mesh_;
  std::vector<int> parent_;  // these three by the file's index
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
