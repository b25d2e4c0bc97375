#include <cmath>

#include "io/assets/gltf_check.h"
#include "io/assets/gltf_materials.h"

namespace focalstage {
namespace {

bool is_wrap(int code) {
  return code == TINYGLTF_TEXTURE_WRAP_REPEAT || code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ||
         code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
}

bool is_magnifying(int code) {
  return code == -1 || code == TINYGLTF_TEXTURE_FILTER_NEAREST || code == TINYGLTF_TEXTURE_FILTER_LINEAR;
}

bool is_minifying(int code) {
  return is_magnifying(code) || (code >= TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST &&
                                 code <= TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR);
}

Status check_images(const GltfDocument& document) {
  const tinygltf::Model& gltf = document.gltf;
  for (std::size_t i = 0; i < gltf.images.size(); ++i) {
    const int view = gltf.images[i].bufferView;
    if (view >= 0 && !is_one_of(view, gltf.bufferViews.size())) {
      return invalid_asset(document.at("images", i) + "/bufferView", "there is no such bufferView");
    }
  }
  for (std::size_t i = 0; i < gltf.samplers.size(); ++i) {
    const tinygltf::Sampler& sampler = gltf.samplers[i];
    const std::string where = document.at("samplers", i);
    if (!is_wrap(sampler.wrapS)) return invalid_asset(where + "/wrapS", "glTF has no such wrapping");
    if (!is_wrap(sampler.wrapT)) return invalid_asset(where + "/wrapT", "glTF has no such wrapping");
    if (!is_magnifying(sampler.magFilter)) return invalid_asset(where + "/magFilter", "glTF has no such filter");
    if (!is_minifying(sampler.minFilter)) return invalid_asset(where + "/minFilter", "glTF has no such filter");
  }
  for (std::size_t i = 0; i < gltf.textures.size(); ++i) {
    const tinygltf::Texture& texture = gltf.textures[i];
    const std::string where = document.at("textures", i);
    if (texture.source >= 0 && !is_one_of(texture.source, gltf.images.size())) {
      return invalid_asset(where + "/source", "there is no such image");
    }
    if (texture.sampler >= 0 && !is_one_of(texture.sampler, gltf.samplers.size())) {
      return invalid_asset(where + "/sampler", "there is no such sampler");
    }
  }
  return {};
}

Status check_layout(const tinygltf::TextureInfo& texture, const std::string& where) {
  const TextureLayout layout = texture_layout(texture);
  const auto within = [](double value, double limit) { return std::abs(value) <= limit; };
  constexpr double most_turn_rad = 1e4;
  constexpr double most = 1e9;
  if (within(layout.rotation, most_turn_rad) && within(layout.offset.x, most) && within(layout.offset.y, most) &&
      within(layout.scale.x, most) && within(layout.scale.y, most)) {
    return {};
  }
  return invalid_asset(where + "/extensions/KHR_texture_transform", "the texture is moved, turned or scaled too far");
}

Status check_material(const GltfDocument& document, std::size_t index) {
  const tinygltf::Material& material = document.gltf.materials[index];
  const std::string where = document.at("materials", index);
  const std::string at_pbr = where + "/pbrMetallicRoughness";
  const std::vector<double>& factor = material.pbrMetallicRoughness.baseColorFactor;
  if (factor.size() != 4) return invalid_asset(at_pbr + "/baseColorFactor", "a base colour has four components");
  for (const double component : factor) {
    if (!(component >= 0.0 && component <= 1.0)) {
      return invalid_asset(at_pbr + "/baseColorFactor", "a base colour is not within 0 and 1");
    }
  }
  const std::string& mode = material.alphaMode;
  if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND") {
    return invalid_asset(where + "/alphaMode", "glTF has no such alpha mode");
  }
  if (!(material.alphaCutoff >= 0.0)) return invalid_asset(where + "/alphaCutoff", "a cutoff is not below 0");
  const int texture = material.pbrMetallicRoughness.baseColorTexture.index;
  if (texture < 0) return {};
  if (!is_one_of(texture, document.gltf.textures.size())) {
    return invalid_asset(at_pbr + "/baseColorTexture/index", "there is no such texture");
  }
  if (document.gltf.textures[static_cast<std::size_t>(texture)].source < 0) {
    return unsupported_asset(document.at("textures", static_cast<std::size_t>(texture)), "a texture has no plain image",
                             "export its picture as PNG or JPEG");
  }
  return check_layout(material.pbrMetallicRoughness.baseColorTexture, at_pbr + "/baseColorTexture");
}

}  // namespace

Status check_gltf_materials(const GltfDocument& document) {
  if (Status images = check_images(document); !images) return images;
  for (std::size_t i = 0; i < document.gltf.materials.size(); ++i) {
    if (Status status = check_material(document, i); !status) return status;
  }
  return {};
}

}  // namespace focalstage
