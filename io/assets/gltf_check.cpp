#include "io/assets/gltf_check.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace focalstage {
namespace {

constexpr std::array<std::string_view, 5> known_extensions{"KHR_materials_unlit", "KHR_texture_transform",
                                                           "KHR_mesh_quantization", "KHR_lights_punctual",
                                                           "KHR_draco_mesh_compression"};
// These change what other members mean: not even a file that only "uses" them is what it seems.
constexpr std::array<std::string_view, 2> changing_extensions{"EXT_meshopt_compression", "EXT_mesh_gpu_instancing"};

template <std::size_t count>
bool is_among(const std::string& name, const std::array<std::string_view, count>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Status check_version(const GltfDocument& document) {
  const tinygltf::Asset& asset = document.gltf.asset;
  if (!asset.version.starts_with("2.")) {
    return unsupported_asset(document.path + ": /asset/version", "only glTF 2.0 is read", "export it as glTF 2.0");
  }
  if (!asset.minVersion.empty() && asset.minVersion != "2.0") {
    return unsupported_asset(document.path + ": /asset/minVersion", "only glTF 2.0 is read", "export it as glTF 2.0");
  }
  return {};
}

Status check_extensions(const GltfDocument& document) {
  for (const std::string& used : document.gltf.extensionsUsed) {
    if (is_among(used, changing_extensions)) {
      return unsupported_asset(document.path + ": /extensionsUsed", used + " is not read", "export without it");
    }
  }
  for (const std::string& required : document.gltf.extensionsRequired) {
    if (!is_among(required, known_extensions)) {
      return unsupported_asset(document.path + ": /extensionsRequired", required.substr(0, 60) + " is not read",
                               "export without it");
    }
  }
  return {};
}

/// What a file uses without requiring it may be left out, but not silently. Those of materials are told with them.
void tell_extensions(const GltfDocument& document, std::vector<Finding>& findings) {
  for (const std::string& used : document.gltf.extensionsUsed) {
    if (is_among(used, known_extensions) || used.starts_with("KHR_materials_")) continue;
    findings.push_back(asset_finding(Severity::info, "asset.extension", document.path + ": /extensionsUsed",
                                     used.substr(0, 60) + " is left out"));
  }
}

}  // namespace

Storage storage_of(const tinygltf::Accessor& accessor) {
  const bool fraction = accessor.normalized;
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return fraction ? stored_i8_fraction : stored_i8;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return fraction ? stored_u8_fraction : stored_u8;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return fraction ? stored_i16_fraction : stored_i16;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return fraction ? stored_u16_fraction : stored_u16;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return stored_u32;
    default:
      return stored_float;
  }
}

Status check_gltf_file(const GltfDocument& document) {
  for (const auto part : {check_version, check_extensions, check_gltf_views}) {
    if (Status status = part(document); !status) return status;
  }
  return {};
}

Result<std::vector<Finding>> check_gltf(const GltfDocument& document) {
  std::vector<Finding> findings;
  tell_extensions(document, findings);
  if (Status status = check_gltf_accessors(document, findings); !status) return status.fault();
  for (const auto part : {check_gltf_materials, check_gltf_cameras_and_lights, check_gltf_meshes, check_gltf_nodes,
                          check_gltf_skins, check_gltf_animations}) {
    if (Status status = part(document); !status) return status.fault();
  }
  return findings;
}

}  // namespace focalstage
