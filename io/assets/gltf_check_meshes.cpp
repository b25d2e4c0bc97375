#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "io/assets/gltf_check.h"
#include "io/assets/gltf_materials.h"

namespace focalstage {
namespace {

constexpr unsigned float_or_fraction = stored_float | stored_u8_fraction | stored_u16_fraction;

/// What an attribute may be stored as (glTF 2.0, 3.7.2.1), and what more with KHR_mesh_quantization.
struct AttributeRule {
  std::string_view name;  ///< with a number behind it where it ends in an underscore
  int type;
  unsigned storage;
  unsigned quantized;
  int other_type = -1;
};

constexpr AttributeRule vertex_rules[] = {
    {"POSITION", TINYGLTF_TYPE_VEC3, stored_float,
     stored_i8 | stored_i8_fraction | stored_u8 | stored_u8_fraction | stored_i16 | stored_i16_fraction | stored_u16 |
         stored_u16_fraction},
    {"NORMAL", TINYGLTF_TYPE_VEC3, stored_float, stored_i8_fraction | stored_i16_fraction},
    {"TANGENT", TINYGLTF_TYPE_VEC4, stored_float, stored_i8_fraction | stored_i16_fraction},
    {"TEXCOORD_", TINYGLTF_TYPE_VEC2, float_or_fraction,
     stored_i8 | stored_i8_fraction | stored_u8 | stored_i16 | stored_i16_fraction | stored_u16},
    {"COLOR_", TINYGLTF_TYPE_VEC3, float_or_fraction, 0, TINYGLTF_TYPE_VEC4},
    {"JOINTS_", TINYGLTF_TYPE_VEC4, stored_u8 | stored_u16, 0},
    {"WEIGHTS_", TINYGLTF_TYPE_VEC4, float_or_fraction, 0},
};

constexpr unsigned quantized_offset = stored_i8 | stored_i8_fraction | stored_i16 | stored_i16_fraction;
constexpr AttributeRule target_rules[] = {
    {"POSITION", TINYGLTF_TYPE_VEC3, stored_float, quantized_offset},
    {"NORMAL", TINYGLTF_TYPE_VEC3, stored_float, stored_i8_fraction | stored_i16_fraction},
    {"TANGENT", TINYGLTF_TYPE_VEC3, stored_float, stored_i8_fraction | stored_i16_fraction},
    {"TEXCOORD_", TINYGLTF_TYPE_VEC2, float_or_fraction | stored_i8_fraction | stored_i16_fraction, quantized_offset},
    {"COLOR_", TINYGLTF_TYPE_VEC3, float_or_fraction | stored_i8_fraction | stored_i16_fraction, 0, TINYGLTF_TYPE_VEC4},
};

bool is_named(const std::string& name, std::string_view rule) {
  return rule.ends_with('_') ? name.starts_with(rule) : name == rule;
}

/// Sets are counted from 0 without a gap: the number of those that an attribute has.
std::size_t sets_of(const std::map<std::string, int>& attributes, const std::string& name) {
  std::size_t sets = 0;
  while (attributes.contains(name + std::to_string(sets))) ++sets;
  return sets;
}

class MeshChecker {
 public:
  explicit MeshChecker(const GltfDocument& document)
      : document_(document), quantized_(document.uses("KHR_mesh_quantization")) {}

  Status check(std::size_t index) {
    const tinygltf::Mesh& mesh = document_.gltf.meshes[index];
    const std::string where = document_.at("meshes", index);
    if (mesh.primitives.empty()) return invalid_asset(where + "/primitives", "a mesh has at least one primitive");
    for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
      where_ = where + "/primitives/" + std::to_string(k);
      if (Status status = check_primitive(mesh.primitives[k]); !status) return status;
      if (mesh.primitives[k].targets.size() != morph_targets(mesh)) {
        return invalid_asset(where_ + "/targets", "a mesh's primitives have the same number of morph targets");
      }
    }
    if (!mesh.weights.empty() && mesh.weights.size() != morph_targets(mesh)) {
      return invalid_asset(where + "/weights", "there are not as many weights as morph targets");
    }
    return {};
  }

 private:
  Status check_primitive(const tinygltf::Primitive& primitive) {
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
      return invalid_asset(where_ + "/mode", "glTF has no such mode");
    }
    if (primitive.material >= 0 && !is_one_of(primitive.material, document_.gltf.materials.size())) {
      return invalid_asset(where_ + "/material", "there is no such material");
    }
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return invalid_asset(where_ + "/attributes", "there is no POSITION");
    const tinygltf::Accessor* first = accessor_at(document_, position->second);
    if (first == nullptr) return invalid_asset(where_ + "/attributes/POSITION", "there is no such accessor");
    if (first->count > most_vertices) {
      return Fault{"asset.too-large", where_, "it holds more than 2^24 vertices", "simplify the mesh"};
    }
    if (Status status = check_attributes(primitive.attributes, vertex_rules, first->count, "/attributes"); !status) {
      return status;
    }
    for (std::size_t i = 0; i < primitive.targets.size(); ++i) {
      const std::string at = "/targets/" + std::to_string(i);
      if (Status status = check_attributes(primitive.targets[i], target_rules, first->count, at); !status)
        return status;
    }
    if (sets_of(primitive.attributes, "JOINTS_") != sets_of(primitive.attributes, "WEIGHTS_")) {
      return invalid_asset(where_ + "/attributes", "there are not as many sets of joints as of weights");
    }
    if (Status status = check_texture_set(primitive); !status) return status;
    return check_corners(primitive, first->count);
  }

  Status check_attributes(const std::map<std::string, int>& attributes, std::span<const AttributeRule> rules,
                          std::size_t vertices, const std::string& at) const {
    for (const auto& [name, index] : attributes) {
      const std::string where = where_ + at + "/" + name.substr(0, 60);
      const tinygltf::Accessor* accessor = accessor_at(document_, index);
      if (accessor == nullptr) return invalid_asset(where, "there is no such accessor");
      if (accessor->count != vertices) return invalid_asset(where, "its count differs from POSITION's");
      const auto rule =
          std::find_if(rules.begin(), rules.end(), [&](const AttributeRule& r) { return is_named(name, r.name); });
      if (rule == rules.end()) continue;
      const unsigned storage = rule->storage | (quantized_ ? rule->quantized : 0u);
      if ((accessor->type != rule->type && accessor->type != rule->other_type) ||
          (storage_of(*accessor) & storage) == 0) {
        return invalid_asset(where, "it is not stored in a way that glTF has for this attribute");
      }
    }
    return {};
  }

  Status check_texture_set(const tinygltf::Primitive& primitive) const {
    if (primitive.material < 0) return {};
    const tinygltf::Material& material = document_.gltf.materials[static_cast<std::size_t>(primitive.material)];
    const tinygltf::TextureInfo& texture = material.pbrMetallicRoughness.baseColorTexture;
    if (texture.index < 0) return {};
    const std::string name = "TEXCOORD_" + std::to_string(texture_layout(texture).uv_set);
    if (primitive.attributes.contains(name)) return {};
    return invalid_asset(where_ + "/attributes", "its material's texture needs " + name);
  }

  Status check_corners(const tinygltf::Primitive& primitive, std::size_t vertices) {
    std::size_t corners = vertices;
    if (primitive.indices >= 0) {
      const tinygltf::Accessor* indices = accessor_at(document_, primitive.indices);
      if (indices == nullptr) return invalid_asset(where_ + "/indices", "there is no such accessor");
      const bool packed = indices->bufferView < 0 ||
                          document_.gltf.bufferViews[static_cast<std::size_t>(indices->bufferView)].byteStride == 0;
      if (indices->type != TINYGLTF_TYPE_SCALAR || !packed ||
          (storage_of(*indices) & (stored_u8 | stored_u16 | stored_u32)) == 0) {
        return invalid_asset(where_ + "/indices", "indices are packed unsigned integers");
      }
      if (largest_index(primitive.indices) >= vertices) {
        return invalid_asset(where_ + "/indices", "an index names no vertex");
      }
      corners = indices->count;
    }
    if (makes_whole(primitive.mode, corners)) return {};
    return invalid_asset(where_, "its corners make no whole triangles, lines or points");
  }

  static bool makes_whole(int mode, std::size_t corners) {
    if (mode == TINYGLTF_MODE_POINTS) return true;
    if (mode == TINYGLTF_MODE_LINE) return corners % 2 == 0;
    if (mode < TINYGLTF_MODE_TRIANGLES) return corners >= 2;
    return corners >= 3 && (mode != TINYGLTF_MODE_TRIANGLES || corners % 3 == 0);
  }

  /// Looked up once, however many primitives share them.
  std::uint32_t largest_index(int accessor) {
    const auto [known, fresh] = largest_.try_emplace(accessor, 0);
    if (!fresh) return known->second;
    const tinygltf::Accessor& from = document_.gltf.accessors[static_cast<std::size_t>(accessor)];
    GltfElements elements(document_, from);
    for (std::size_t i = 0; i < from.count; ++i) {
      elements.next();
      known->second = std::max(known->second, static_cast<std::uint32_t>(elements.stored(0)));
    }
    return known->second;
  }

  const GltfDocument& document_;
  const bool quantized_;
  std::string where_;  ///< the primitive at hand
  std::map<int, std::uint32_t> largest_;
};

}  // namespace

std::size_t morph_targets(const tinygltf::Mesh& mesh) {
  return mesh.primitives.empty() ? 0 : mesh.primitives.front().targets.size();
}

Status check_gltf_meshes(const GltfDocument& document) {
  MeshChecker checker(document);
  for (std::size_t i = 0; i < document.gltf.meshes.size(); ++i) {
    if (Status status = checker.check(i); !status) return status;
  }
  return {};
}

}  // namespace focalstage
