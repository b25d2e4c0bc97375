#include "io/assets/gltf_materials.h"

#include <algorithm>

#include "core/mesh/circle.h"
#include "io/image/png.h"

namespace focalstage {
namespace {

Wrap wrap_from(int code) {
  if (code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::mirror;
  return code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE ? Wrap::clamp : Wrap::repeat;
}

/// Alpha of a picture's pixels, 0 to 1.
struct AlphaRange {
  double least = 1.0;
  double most = 1.0;
};

template <class Number>
AlphaRange alpha_in(const std::vector<Number>& rgba, double full) {
  AlphaRange range{1.0, 0.0};
  for (std::size_t i = 3; i < rgba.size(); i += 4) {
    range.least = std::min(range.least, rgba[i] / full);
    range.most = std::max(range.most, rgba[i] / full);
  }
  return range;
}

AlphaRange alpha_of(const Texture* texture) {
  if (texture == nullptr) return {};
  return texture->is_deep() ? alpha_in(texture->rgba16, 65535.0) : alpha_in(texture->rgba, 255.0);
}

double number_in(const tinygltf::Value& value, double otherwise) {
  return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
}

glm::dvec2 pair_in(const tinygltf::Value& object, const std::string& name, const glm::dvec2& otherwise) {
  const tinygltf::Value& pair = object.Get(name);
  if (!pair.IsArray() || pair.ArrayLen() != 2) return otherwise;
  return {number_in(pair.Get(0), otherwise.x), number_in(pair.Get(1), otherwise.y)};
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
    Material material;
    material.name = from.name;
    material.unlit = from.extensions.contains("KHR_materials_unlit");
    const std::vector<double>& factor = from.pbrMetallicRoughness.baseColorFactor;
    material.base_color = {factor[0], factor[1], factor[2]};
    const tinygltf::TextureInfo& texture = from.pbrMetallicRoughness.baseColorTexture;
    if (texture.index >= 0) {
      Result<std::shared_ptr<const Texture>> read = read_texture(texture.index);
      if (!read) return read.fault();
      material.texture = *read;
    }
    if (!material.unlit) tell_left_out(from, index);
    result_.invisible.push_back(cut_away(from, index, alpha_of(material.texture.get()), material.alpha_cutoff));
    result_.layouts.push_back(texture.index < 0 ? TextureLayout{} : texture_layout(texture));
    result_.materials.push_back(std::move(material));
    return {};
  }

  /// Lights act on what is drawn as on matt paper: what a material says beyond its base colour is told.
  void tell_left_out(const tinygltf::Material& from, std::size_t index) {
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    const auto written = [&](const char* key) { return from.values.contains(key); };
    std::string what;
    const auto add = [&](bool there, const std::string& name) {
      if (there) what += (what.empty() ? "" : ", ") + name;
    };
    const bool mapped = pbr.metallicRoughnessTexture.index >= 0;
    add(mapped || (written("metallicFactor") && pbr.metallicFactor > 0.0), "metal");
    add(mapped || (written("roughnessFactor") && pbr.roughnessFactor < 1.0), "gloss");
    const auto is_light = [](double factor) { return factor > 0.0; };
    add(std::ranges::any_of(from.emissiveFactor, is_light), "light of its own");
    add(from.normalTexture.index >= 0, "a normal map");
    add(from.occlusionTexture.index >= 0, "occlusion");
    for (const auto& [name, value] : from.extensions) add(true, name.substr(0, 60));
    if (what.empty()) return;
    result_.findings.push_back(asset_finding(Severity::info, "asset.drawn-matt", document_.at("materials", index),
                                             "the material is drawn matt; left out: " + what));
  }

  /// Whether its alpha is below the cutoff everywhere. A mask that is neither that nor opaque everywhere is cut where
  /// its texture says; what blends is drawn opaque.
  bool cut_away(const tinygltf::Material& from, std::size_t index, const AlphaRange& of_texture, double& cutoff) {
    if (from.alphaMode == "OPAQUE") return false;
    const double factor = from.pbrMetallicRoughness.baseColorFactor[3];
    const double least = factor * of_texture.least;
    const double most = factor * of_texture.most;
    const bool mask = from.alphaMode == "MASK";
    if (mask && most < from.alphaCutoff) return true;
    if (least >= (mask ? from.alphaCutoff : 1.0)) return false;
    if (mask) {
      cutoff = from.alphaCutoff / factor;  // not zero, or most would be
      return false;
    }
    result_.findings.push_back(asset_finding(Severity::info, "asset.drawn-opaque", document_.at("materials", index),
                                             "the material lets light through; it is drawn opaque"));
    return false;
  }

  Result<std::shared_ptr<const Texture>> read_texture(int index) {
    const tinygltf::Model& gltf = document_.gltf;
    const tinygltf::Texture& texture = gltf.textures[static_cast<std::size_t>(index)];
    tinygltf::Sampler sampler;  // repeats, as glTF without one
    if (texture.sampler >= 0) sampler = gltf.samplers[static_cast<std::size_t>(texture.sampler)];
    const Wrap wrap_u = wrap_from(sampler.wrapS);
    const Wrap wrap_v = wrap_from(sampler.wrapT);
    const Magnify magnify = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST ? Magnify::nearest : Magnify::linear;
    std::shared_ptr<const Texture>& known = textures_[{texture.source, wrap_u, wrap_v, magnify}];
    if (!known) {
      Result<Texture> decoded = decode(static_cast<std::size_t>(texture.source));
      if (!decoded) return decoded.fault();
      decoded->wrap_u = wrap_u;
      decoded->wrap_v = wrap_v;
      decoded->magnify = magnify;
      known = std::make_shared<const Texture>(*std::move(decoded));
    }
    return known;
  }

  Result<Texture> decode(std::size_t index) {
    const tinygltf::Image& image = document_.gltf.images[index];
    const std::string where = document_.at("images", index);
    std::span<const std::byte> bytes = std::as_bytes(std::span(image.image));
    if (image.bufferView >= 0) bytes = view_bytes(document_.gltf, image.bufferView);
    Result<Texture> texture = decode_image(bytes, where, PixelBits::as_stored);
    if (!texture) return texture;
    pixels_left_ -= std::int64_t{texture->width_px} * texture->height_px;
    if (pixels_left_ < 0) {
      return Fault{"asset.too-large", where, "its textures have more than 2^27 pixels together", "scale them down"};
    }
    return texture;
  }

  const GltfDocument& document_;
  GltfMaterials result_;
  std::map<std::tuple<int, Wrap, Wrap, Magnify>, std::shared_ptr<const Texture>> textures_;
  std::int64_t pixels_left_ = std::int64_t{1} << 27;
};

}  // namespace

glm::dvec2 TextureLayout::uv_from(const glm::dvec2& gltf_uv) const {
  const glm::dvec2 scaled = gltf_uv * scale;
  const SinCos turn = sin_cos(rotation);
  // V runs down: a turn that is counter-clockwise to the eye lowers it.
  const glm::dvec2 turned{turn.cos * scaled.x + turn.sin * scaled.y, turn.cos * scaled.y - turn.sin * scaled.x};
  const glm::dvec2 moved = turned + offset;
  return {moved.x, 1.0 - moved.y};
}

TextureLayout texture_layout(const tinygltf::TextureInfo& texture) {
  TextureLayout layout;
  layout.uv_set = texture.texCoord;
  const auto found = texture.extensions.find("KHR_texture_transform");
  if (found == texture.extensions.end()) return layout;
  const tinygltf::Value& transform = found->second;
  layout.offset = pair_in(transform, "offset", layout.offset);
  layout.scale = pair_in(transform, "scale", layout.scale);
  layout.rotation = number_in(transform.Get("rotation"), layout.rotation);
  if (transform.Get("texCoord").IsNumber()) layout.uv_set = transform.Get("texCoord").GetNumberAsInt();
  return layout;
}

Result<GltfMaterials> read_gltf_materials(const GltfDocument& document) { return MaterialReader(document).read(); }

}  // namespace focalstage
