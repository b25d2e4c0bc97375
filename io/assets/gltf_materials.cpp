#include "io/assets/gltf_materials.h"

#include <cmath>

#include "io/image/png.h"

namespace focalstage {
namespace {

Wrap wrap_from(int code) {
  if (code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::mirror;
  return code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE ? Wrap::clamp : Wrap::repeat;
}

class MaterialReader {
 public:
  explicit MaterialReader(const GltfDocument& document) : document_(document) {}

  Result<GltfMaterials> read() {
    for (std::size_t i = 0; i < document_.gltf.materials.size(); ++i) {
      if (Status status = read_material(i); !status) return status.fault();
    }
    return std::move(result_);
  }

 private:
  Status read_material(std::size_t index) {
    const tinygltf::Material& from = document_.gltf.materials[index];
    const std::string where = document_.at("materials", index);
    Material material;
    material.name = from.name;
    material.unlit = from.extensions.contains("KHR_materials_unlit");
    const std::vector<double>& factor = from.pbrMetallicRoughness.baseColorFactor;
    material.base_color = {factor[0], factor[1], factor[2]};
    if (from.alphaMode != "OPAQUE") {
      result_.findings.push_back(asset_finding(Severity::info, "asset.drawn-opaque", where,
                                               "the material lets light through; it is drawn opaque"));
    }
    const tinygltf::TextureInfo& texture = from.pbrMetallicRoughness.baseColorTexture;
    int uv_set = -1;
    if (texture.index >= 0) {
      if (texture.extensions.contains("KHR_texture_transform")) {
        return unsupported_asset(where, "a texture is moved over its mesh (KHR_texture_transform)",
                                 "apply the transform to the UVs");
      }
      Result<std::shared_ptr<const Texture>> read = read_texture(texture.index);
      if (!read) return read.fault();
      material.texture = *read;
      uv_set = texture.texCoord;
    }
    result_.materials.push_back(std::move(material));
    result_.uv_set.push_back(uv_set);
    return {};
  }

  Result<std::shared_ptr<const Texture>> read_texture(int index) {
    const tinygltf::Model& gltf = document_.gltf;
    const tinygltf::Texture& texture = gltf.textures[static_cast<std::size_t>(index)];
    tinygltf::Sampler sampler;  // repeats, as glTF without one
    if (texture.sampler >= 0) sampler = gltf.samplers[static_cast<std::size_t>(texture.sampler)];
    const Wrap wrap_u = wrap_from(sampler.wrapS);
    const Wrap wrap_v = wrap_from(sampler.wrapT);
    std::shared_ptr<const Texture>& known = textures_[{texture.source, wrap_u, wrap_v}];
    if (!known) {
      Result<Texture> decoded = decode(static_cast<std::size_t>(texture.source));
      if (!decoded) return decoded.fault();
      decoded->wrap_u = wrap_u;
      decoded->wrap_v = wrap_v;
      known = std::make_shared<const Texture>(*std::move(decoded));
    }
    return known;
  }

  Result<Texture> decode(std::size_t index) {
    const tinygltf::Image& image = document_.gltf.images[index];
    const std::string where = document_.at("images", index);
    std::span<const std::byte> bytes = std::as_bytes(std::span(image.image));
    if (image.bufferView >= 0) bytes = view_bytes(document_.gltf, image.bufferView);
    Result<Texture> texture = decode_image(bytes, where);
    if (!texture) return texture;
    pixels_left_ -= static_cast<std::int64_t>(texture->rgba.size() / 4);
    if (pixels_left_ < 0) {
      return Fault{"asset.too-large", where, "its textures have more than 2^27 pixels together", "scale them down"};
    }
    return texture;
  }

  const GltfDocument& document_;
  GltfMaterials result_;
  std::map<std::tuple<int, Wrap, Wrap>, std::shared_ptr<const Texture>> textures_;
  std::int64_t pixels_left_ = std::int64_t{1} << 27;
};

}  // namespace

Result<GltfMaterials> read_gltf_materials(const GltfDocument& document) { return MaterialReader(document).read(); }

}  // namespace focalstage
