#include <algorithm>
#include <cmath>

#include "io/assets/gltf_cameras_lights.h"
#include "io/assets/gltf_check.h"

namespace focalstage {
namespace {

constexpr std::size_t most_weights = std::size_t{1} << 20;

class NodeChecker {
 public:
  explicit NodeChecker(const GltfDocument& document) : document_(document), nodes_(document.gltf.nodes) {}

  Status check() {
    for (const auto part : {&NodeChecker::check_parents, &NodeChecker::check_circles, &NodeChecker::check_scenes}) {
      if (Status status = (this->*part)(); !status) return status;
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (Status status = check_pose(i); !status) return status;
      if (Status status = check_content(i); !status) return status;
    }
    return {};
  }

 private:
  Status check_parents() {
    parent_.assign(nodes_.size(), -1);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      for (const int child : nodes_[i].children) {
        const std::string where = document_.at("nodes", i) + "/children";
        if (!is_one_of(child, nodes_.size())) return invalid_asset(where, "there is no such node");
        int& parent = parent_[static_cast<std::size_t>(child)];
        if (parent >= 0) return invalid_asset(where, "node " + std::to_string(child) + " has two parents");
        parent = static_cast<int>(i);
      }
    }
    return {};
  }

  /// From the roots down, without recursion. With one parent at most, whoever is not reached stands in a circle.
  Status check_circles() {
    std::vector<std::size_t> reached;
    std::vector<bool> is_reached(nodes_.size(), false);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (parent_[i] < 0) reached.push_back(i);
    }
    for (std::size_t at = 0; at < reached.size(); ++at) {
      is_reached[reached[at]] = true;
      for (const int child : nodes_[reached[at]].children) reached.push_back(static_cast<std::size_t>(child));
    }
    const auto lost = std::find(is_reached.begin(), is_reached.end(), false);
    if (lost == is_reached.end()) return {};
    return invalid_asset(document_.at("nodes", static_cast<std::size_t>(lost - is_reached.begin())),
                         "the node is among its own ancestors");
  }

  Status check_scenes() {
    const std::vector<tinygltf::Scene>& scenes = document_.gltf.scenes;
    if (document_.gltf.defaultScene >= static_cast<int>(scenes.size())) {
      return invalid_asset(document_.path + ": /scene", "there is no such scene");
    }
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const std::string where = document_.at("scenes", i) + "/nodes";
      for (const int root : scenes[i].nodes) {
        if (!is_one_of(root, nodes_.size())) return invalid_asset(where, "there is no such node");
        if (parent_[static_cast<std::size_t>(root)] >= 0) return invalid_asset(where, "a scene's node has a parent");
      }
    }
    return {};
  }

  Status check_pose(std::size_t index) const {
    const tinygltf::Node& node = nodes_[index];
    const std::string where = document_.at("nodes", index);
    const auto has = [](const std::vector<double>& numbers, std::size_t count) {
      return numbers.empty() || numbers.size() == count;
    };
    if (!has(node.matrix, 16) || !has(node.translation, 3) || !has(node.rotation, 4) || !has(node.scale, 3)) {
      return invalid_asset(where, "its pose has the wrong count of numbers");
    }
    if (!node.matrix.empty() &&
        (node.matrix[3] != 0.0 || node.matrix[7] != 0.0 || node.matrix[11] != 0.0 || node.matrix[15] != 1.0)) {
      return invalid_asset(where + "/matrix", "the matrix is not affine: its last row is not 0 0 0 1");
    }
    if (node.rotation.empty()) return {};
    double square = 0.0;
    for (const double component : node.rotation) square += component * component;
    constexpr double tolerance = 0.01;
    if (!(std::abs(std::sqrt(square) - 1.0) <= tolerance)) {
      return invalid_asset(where + "/rotation", "the quaternion is not of unit length");
    }
    return {};
  }

  Status check_content(std::size_t index) {
    const tinygltf::Node& node = nodes_[index];
    const std::string where = document_.at("nodes", index);
    const std::vector<tinygltf::Mesh>& meshes = document_.gltf.meshes;
    if (node.mesh >= 0 && !is_one_of(node.mesh, meshes.size())) {
      return invalid_asset(where + "/mesh", "there is no such mesh");
    }
    if (node.camera >= 0 && !is_one_of(node.camera, document_.gltf.cameras.size())) {
      return invalid_asset(where + "/camera", "there is no such camera");
    }
    const int light = light_of_node(node);
    if (light >= 0 && !is_one_of(light, document_.gltf.lights.size())) {
      return invalid_asset(where + "/extensions/KHR_lights_punctual/light", "there is no such light");
    }
    const std::size_t targets = node.mesh < 0 ? 0 : morph_targets(meshes[static_cast<std::size_t>(node.mesh)]);
    if (!node.weights.empty() && node.weights.size() != targets) {
      return invalid_asset(where + "/weights", "there are not as many weights as morph targets");
    }
    weights_ += targets;
    if (weights_ <= most_weights) return {};
    return Fault{"asset.too-large", where, "the nodes have more than 2^20 weights of morph targets together",
                 "use fewer shape keys"};
  }

  const GltfDocument& document_;
  const std::vector<tinygltf::Node>& nodes_;
  std::vector<int> parent_;
  std::size_t weights_ = 0;
};

}  // namespace

std::vector<int> gltf_parents(const tinygltf::Model& gltf) {
  std::vector<int> parents(gltf.nodes.size(), -1);
  for (std::size_t i = 0; i < gltf.nodes.size(); ++i) {
    for (const int child : gltf.nodes[i].children) parents[static_cast<std::size_t>(child)] = static_cast<int>(i);
  }
  return parents;
}

Status check_gltf_nodes(const GltfDocument& document) { return NodeChecker(document).check(); }

}  // namespace focalstage
