#include "io/assets/gltf_deformations.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace focalstage {
namespace {

constexpr std::size_t most_values = 2 * most_vertices;  ///< offsets and shares of one file

int attribute_of(const std::map<std::string, int>& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? -1 : found->second;
}

/// The vectors of an accessor one after the other; zeros where there is none.
class Offsets {
 public:
  Offsets(const GltfDocument& document, int accessor) {
    if (accessor >= 0) elements_.emplace(document, *accessor_at(document, accessor));
  }

  glm::dvec3 next() {
    if (!elements_) return glm::dvec3(0.0);
    elements_->next();
    return {elements_->number(0), elements_->number(1), elements_->number(2)};
  }

 private:
  std::optional<GltfElements> elements_;
};

}  // namespace

Result<std::shared_ptr<const Deformation>> GltfDeformations::of(const tinygltf::Primitive& primitive,
                                                                const std::string& where) {
  const Sources sources = find_sources(primitive, where);
  if (sources.targets.empty() && sources.joints.empty()) return std::shared_ptr<const Deformation>();
  std::shared_ptr<const Deformation>& known = known_[sources];
  if (known) return known;
  const std::size_t vertices = accessor_at(document_, primitive.attributes.at("POSITION"))->count;
  if (Status status = take(sources, vertices, where); !status) return status.fault();
  Deformation deformation;
  for (std::size_t i = 0; i < sources.targets.size(); i += 2) {
    deformation.targets.push_back(read_target(sources.targets[i], sources.targets[i + 1], vertices));
  }
  if (!sources.joints.empty()) read_shares(sources, where, deformation);
  known = std::make_shared<const Deformation>(std::move(deformation));
  return known;
}

GltfDeformations::Sources GltfDeformations::find_sources(const tinygltf::Primitive& primitive,
                                                         const std::string& where) {
  Sources sources;
  bool left_out = false;
  for (const std::map<std::string, int>& target : primitive.targets) {
    sources.targets.push_back(attribute_of(target, "POSITION"));
    sources.targets.push_back(attribute_of(target, "NORMAL"));
    left_out = left_out || std::any_of(target.begin(), target.end(), [](const auto& attribute) {
                 return attribute.first.starts_with("TEXCOORD_") || attribute.first.starts_with("COLOR_");
               });
  }
  if (left_out) {
    findings_.push_back(asset_finding(Severity::warning, "asset.morph-left-out", where + "/targets",
                                      "morph targets move positions and normals; their colours and UVs are left out"));
  }
  for (int set = 0;; ++set) {
    const int joints = attribute_of(primitive.attributes, "JOINTS_" + std::to_string(set));
    if (joints < 0) return sources;
    sources.joints.push_back(joints);
    sources.joints.push_back(attribute_of(primitive.attributes, "WEIGHTS_" + std::to_string(set)));
  }
}

/// Before anything is allocated.
Status GltfDeformations::take(const Sources& sources, std::size_t vertices, const std::string& where) {
  values_ += vertices * (sources.targets.size() / 2 + 2 * sources.joints.size());
  if (values_ <= most_values) return {};
  return Fault{"asset.too-large", where, "the morph targets and joints move more than 2^25 values together",
               "simplify the meshes"};
}

MorphTarget GltfDeformations::read_target(int offsets, int normal_offsets, std::size_t vertices) const {
  MorphTarget target;
  Offsets of_position(document_, offsets);
  Offsets of_normal(document_, normal_offsets);
  for (std::size_t i = 0; i < vertices; ++i) {
    const glm::dvec3 position = of_position.next();
    const glm::dvec3 normal = of_normal.next();
    if (position == glm::dvec3(0.0) && normal == glm::dvec3(0.0)) continue;
    target.vertices.push_back(static_cast<std::uint32_t>(i));
    target.offsets_m.push_back(position);
    if (normal_offsets >= 0) target.normal_offsets.push_back(normal);
  }
  return target;
}

void GltfDeformations::read_shares(const Sources& sources, const std::string& where, Deformation& deformation) {
  std::vector<GltfElements> joints;
  std::vector<GltfElements> weights;
  for (std::size_t i = 0; i < sources.joints.size(); i += 2) {
    joints.emplace_back(document_, *accessor_at(document_, sources.joints[i]));
    weights.emplace_back(document_, *accessor_at(document_, sources.joints[i + 1]));
  }
  const std::size_t vertices = accessor_at(document_, sources.joints.front())->count;
  bool whole = true;
  deformation.first_share.push_back(0);
  for (std::size_t i = 0; i < vertices; ++i) {
    const std::size_t first = deformation.shares.size();
    double sum = 0.0;
    for (std::size_t set = 0; set < joints.size(); ++set) {
      joints[set].next();
      weights[set].next();
      for (std::size_t k = 0; k < 4; ++k) {
        const double weight = weights[set].number(k);
        if (!(weight > 0.0)) continue;
        deformation.shares.push_back({static_cast<std::uint32_t>(joints[set].stored(k)), weight});
        sum += weight;
      }
    }
    for (std::size_t k = first; k < deformation.shares.size(); ++k) deformation.shares[k].weight /= sum;
    deformation.first_share.push_back(static_cast<std::uint32_t>(deformation.shares.size()));
    whole = whole && std::abs(sum - 1.0) < 0.01;  // 8-bit weights add up to that
  }
  if (!whole) {
    findings_.push_back(asset_finding(Severity::warning, "asset.weights", where + "/attributes/WEIGHTS_0",
                                      "the joint weights of some vertices do not add up to one; they are scaled"));
  }
}

std::vector<Skin> read_gltf_skins(const GltfDocument& document, const std::vector<int>& node_of_gltf) {
  std::vector<Skin> skins;
  for (const tinygltf::Skin& from : document.gltf.skins) {
    Skin& skin = skins.emplace_back();
    for (const int joint : from.joints) skin.joints.push_back(node_of_gltf[static_cast<std::size_t>(joint)]);
    if (from.inverseBindMatrices >= 0) skin.joint_from_mesh = read_matrices(document, from.inverseBindMatrices);
    skin.joint_from_mesh.resize(skin.joints.size(), glm::dmat4(1.0));
    for (glm::dmat4& matrix : skin.joint_from_mesh) {
      for (int column = 0; column < 4; ++column) matrix[column][3] = column == 3 ? 1.0 : 0.0;  // but for rounding
    }
  }
  return skins;
}

}  // namespace focalstage
