#pragma once

#include <nlohmann/json.hpp>

#include "io/image/png.h"
#include "tests/io/assets/reading.h"

namespace focalstage::test {

using Json = nlohmann::json;

/// A glTF to be spoilt: two triangles with normals, UVs, a texture in the buffer, a node on a node, an animation.
struct Gltf {
  Json json;
  Bytes buffer;

  /// Appends data as a bufferView of its own; the view's index.
  std::size_t add_view(const Bytes& data) {
    while (buffer.size() % 4 != 0) buffer.push_back(std::byte{0});
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", data.size()}});
    buffer.insert(buffer.end(), data.begin(), data.end());
    json["buffers"][0]["byteLength"] = buffer.size();
    return json["bufferViews"].size() - 1;
  }

  std::size_t add_floats(const std::string& type, const std::vector<float>& values) {
    Bytes data;
    for (const float value : values) put(data, value);
    const std::size_t components = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : 4;
    json["accessors"].push_back({{"bufferView", add_view(data)},
                                 {"componentType", 5126},
                                 {"count", values.size() / components},
                                 {"type", type}});
    return json["accessors"].size() - 1;
  }

  std::size_t add_indices(const std::vector<std::uint16_t>& values) {
    Bytes data;
    for (const std::uint16_t value : values) put(data, value);
    json["accessors"].push_back(
        {{"bufferView", add_view(data)}, {"componentType", 5123}, {"count", values.size()}, {"type", "SCALAR"}});
    return json["accessors"].size() - 1;
  }

  Bytes glb() const {
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    Bytes data = buffer;
    data.resize((data.size() + 3) / 4 * 4);
    Bytes bytes = bytes_of("glTF");
    put(bytes, std::uint32_t{2});
    put(bytes, static_cast<std::uint32_t>(12 + 8 + text.size() + (data.empty() ? 0 : 8 + data.size())));
    put(bytes, static_cast<std::uint32_t>(text.size()));
    put(bytes, std::uint32_t{0x4E4F534A});
    const Bytes json_bytes = bytes_of(text);
    bytes.insert(bytes.end(), json_bytes.begin(), json_bytes.end());
    if (data.empty()) return bytes;
    put(bytes, static_cast<std::uint32_t>(data.size()));
    put(bytes, std::uint32_t{0x004E4942});
    bytes.insert(bytes.end(), data.begin(), data.end());
    return bytes;
  }
};

/// A square of 1 m from the origin in XY with the lower left corner red in its 2 x 2 texture.
inline Gltf square_gltf() {
  Gltf gltf;
  gltf.json = {{"asset", {{"version", "2.0"}}},
               {"scene", 0},
               {"scenes", {{{"nodes", {0}}}}},
               {"nodes",
                {{{"name", "root"}, {"children", {1}}, {"translation", {1, 2, 3}}},
                 {{"name", "leaf"}, {"mesh", 0}, {"scale", {2, 2, 2}}}}},
               {"buffers", {{{"byteLength", 0}}}}};
  Json primitive = {{"material", 0}};
  primitive["attributes"]["POSITION"] = gltf.add_floats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  primitive["attributes"]["NORMAL"] = gltf.add_floats("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  primitive["attributes"]["TEXCOORD_0"] = gltf.add_floats("VEC2", {0, 1, 1, 1, 1, 0, 0, 0});
  primitive["indices"] = gltf.add_indices({0, 1, 2, 0, 2, 3});
  gltf.json["meshes"].push_back({{"primitives", {primitive}}});
  const std::vector<std::uint8_t> pixels{0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255};
  const std::size_t view = gltf.add_view(*encode_png(2, 2, 3, pixels));
  gltf.json["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
  gltf.json["samplers"].push_back({{"wrapS", 33071}, {"wrapT", 33648}});
  gltf.json["textures"].push_back({{"source", 0}, {"sampler", 0}});
  gltf.json["materials"].push_back(
      {{"name", "tiles"},
       {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0.25, 1}}, {"baseColorTexture", {{"index", 0}}}}}});
  Json sampler;
  sampler["input"] = gltf.add_floats("SCALAR", {0, 0.5, 2});
  sampler["output"] = gltf.add_floats("VEC3", {0, 0, 0, 1, 0, 0, 1, 4, 0});
  gltf.json["animations"].push_back(
      {{"name", "move"},
       {"samplers", {sampler}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}});
  return gltf;
}

}  // namespace focalstage::test
