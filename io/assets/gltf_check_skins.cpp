#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "io/assets/gltf_check.h"

namespace focalstage {
namespace {

class SkinChecker {
 public:
  explicit SkinChecker(const GltfDocument& document) : document_(document), parent_(gltf_parents(document.gltf)) {}

  Status check_skin(std::size_t index) {
    const tinygltf::Skin& skin = document_.gltf.skins[index];
    const std::string where = document_.at("skins", index);
    if (skin.joints.empty()) return invalid_asset(where + "/joints", "a skin has at least one joint");
    std::set<int> seen;
    for (const int joint : skin.joints) {
      if (!is_one_of(joint, parent_.size())) return invalid_asset(where + "/joints", "there is no such node");
      if (!seen.insert(joint).second) return invalid_asset(where + "/joints", "a joint is named twice");
    }
    if (skin.skeleton >= 0 && !is_one_of(skin.skeleton, parent_.size())) {
      return invalid_asset(where + "/skeleton", "there is no such node");
    }
    const int root = root_of(skin.joints.front());
    if (std::any_of(skin.joints.begin(), skin.joints.end(), [&](int joint) { return root_of(joint) != root; })) {
      return invalid_asset(where + "/joints", "the joints have no common root");
    }
    return check_inverse_binds(skin, where);
  }

  /// A skin needs a mesh whose vertices name its joints.
  Status check_node(std::size_t index) {
    const tinygltf::Node& node = document_.gltf.nodes[index];
    if (node.skin < 0) return {};
    const std::string where = document_.at("nodes", index) + "/skin";
    if (!is_one_of(node.skin, document_.gltf.skins.size())) return invalid_asset(where, "there is no such skin");
    if (node.mesh < 0) return invalid_asset(where, "the node has a skin but no mesh");
    const std::size_t joints = document_.gltf.skins[static_cast<std::size_t>(node.skin)].joints.size();
    const tinygltf::Mesh& mesh = document_.gltf.meshes[static_cast<std::size_t>(node.mesh)];
    for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
      const std::string at = document_.at("meshes", static_cast<std::size_t>(node.mesh)) + "/primitives/" +
                             std::to_string(k) + "/attributes";
      if (Status status = check_weights(mesh.primitives[k], joints, at); !status) return status;
    }
    return {};
  }

 private:
  int root_of(int node) {
    if (roots_.empty()) roots_.assign(parent_.size(), -1);
    std::vector<int> path;
    while (roots_[static_cast<std::size_t>(node)] < 0 && parent_[static_cast<std::size_t>(node)] >= 0) {
      path.push_back(node);
      node = parent_[static_cast<std::size_t>(node)];
    }
    int& known = roots_[static_cast<std::size_t>(node)];
    if (known < 0) known = node;
    for (const int passed : path) roots_[static_cast<std::size_t>(passed)] = known;
    return known;
  }

  Status check_inverse_binds(const tinygltf::Skin& skin, const std::string& where) const {
    if (skin.inverseBindMatrices < 0) return {};
    const tinygltf::Accessor* binds = accessor_at(document_, skin.inverseBindMatrices);
    const std::string at = where + "/inverseBindMatrices";
    if (binds == nullptr) return invalid_asset(at, "there is no such accessor");
    if (binds->type != TINYGLTF_TYPE_MAT4 || storage_of(*binds) != stored_float) {
      return invalid_asset(at, "inverse bind matrices are matrices of 4 by 4 floats");
    }
    if (binds->count < skin.joints.size()) return invalid_asset(at, "there are fewer matrices than joints");
    GltfElements elements(document_, *binds);
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
      elements.next();
      constexpr double float_rounding = 1e-5;
      for (const std::size_t k : {3u, 7u, 11u, 15u}) {
        if (std::abs(elements.stored(k) - (k == 15 ? 1.0 : 0.0)) > float_rounding) {
          return invalid_asset(at, "matrix " + std::to_string(i) + " is not affine: its last row is not 0 0 0 1");
        }
      }
    }
    return {};
  }

  /// Joints that weigh something are the skin's, no weight is negative, and each vertex hangs on some joint.
  Status check_weights(const tinygltf::Primitive& primitive, std::size_t joints, const std::string& where) {
    if (!primitive.attributes.contains("JOINTS_0")) return invalid_asset(where, "its node's skin needs JOINTS_0");
    const tinygltf::Accessor& first = *accessor_at(document_, primitive.attributes.at("JOINTS_0"));
    std::vector<double> sum(first.count, 0.0);
    for (std::size_t set = 0; primitive.attributes.contains("JOINTS_" + std::to_string(set)); ++set) {
      const std::string number = std::to_string(set);
      const Status status = check_set(primitive.attributes.at("JOINTS_" + number),
                                      primitive.attributes.at("WEIGHTS_" + number), joints, where, sum);
      if (!status) return status;
    }
    const bool whole = std::all_of(sum.begin(), sum.end(), [](double weight) { return weight > 0.0; });
    return whole ? Status{} : invalid_asset(where + "/WEIGHTS_0", "a vertex hangs on no joint");
  }

  Status check_set(int joints, int weights, std::size_t count, const std::string& where, std::vector<double>& sum) {
    checked_ += sum.size();
    if (checked_ > most_vertices) {
      return Fault{"asset.too-large", where, "the skins move more than 2^24 vertices", "simplify the meshes"};
    }
    GltfElements joint(document_, *accessor_at(document_, joints));
    GltfElements weight(document_, *accessor_at(document_, weights));
    for (double& of_vertex : sum) {
      joint.next();
      weight.next();
      for (std::size_t k = 0; k < 4; ++k) {
        const double share = weight.number(k);
        if (share < 0.0) return invalid_asset(where + "/WEIGHTS_0", "a weight is negative");
        if (share > 0.0 && joint.stored(k) >= static_cast<double>(count)) {
          return invalid_asset(where + "/JOINTS_0", "a vertex names a joint that its skin has not");
        }
        of_vertex += share;
      }
    }
    return {};
  }

  const GltfDocument& document_;
  std::vector<int> parent_;
  std::vector<int> roots_;  ///< those found so far
  std::size_t checked_ = 0;
};

}  // namespace

Status check_gltf_skins(const GltfDocument& document) {
  SkinChecker checker(document);
  for (std::size_t i = 0; i < document.gltf.skins.size(); ++i) {
    if (Status status = checker.check_skin(i); !status) return status;
  }
  for (std::size_t i = 0; i < document.gltf.nodes.size(); ++i) {
    if (Status status = checker.check_node(i); !status) return status;
  }
  return {};
}

}  // namespace focalstage
