#include "io/assets/image_plane.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <string>

#include <nlohmann/json.hpp>

#include "io/image/png.h"

namespace focalstage {
namespace {

using nlohmann::json;

// glTF 2.0, sections 3.6.2 (accessors), 3.11 and 4.4 (GLB).
constexpr std::uint32_t glb_magic = 0x46546C67, glb_version = 2, json_chunk = 0x4E4F534A, bin_chunk = 0x004E4942;
constexpr int float_component = 5126, short_component = 5123, array_buffer = 34962, index_buffer = 34963;

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

void append(std::vector<std::byte>& bytes, const void* data, std::size_t size) {
  const auto* from = static_cast<const std::byte*>(data);
  bytes.insert(bytes.end(), from, from + size);
}

void append(std::vector<std::byte>& bytes, std::uint32_t number) { append(bytes, &number, sizeof number); }

void pad(std::vector<std::byte>& bytes, std::byte with) {
  while (bytes.size() % 4 != 0) bytes.push_back(with);
}

/// Positions, texture coordinates, indices, picture, each on a boundary of four.
struct Plane {
  std::vector<std::byte> bytes;
  json views = json::array();

  void add(const void* data, std::size_t size, int target) {
    json view{{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}};
    if (target != 0) view["target"] = target;
    views.push_back(view);
    append(bytes, data, size);
    pad(bytes, std::byte{0});
  }
};

json describe(const Plane& plane, float half_height, const std::string& mime, const std::string& name) {
  json root;
  root["asset"] = {{"version", "2.0"}, {"generator", "focalstage"}};
  root["extensionsUsed"] = {"KHR_materials_unlit"};
  root["scene"] = 0;
  root["scenes"] = json::array({{{"nodes", {0}}}});
  root["nodes"] = json::array({{{"mesh", 0}, {"name", name}}});
  root["meshes"] = json::array(
      {{{"primitives",
         json::array({{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"indices", 2}, {"material", 0}}})}}});
  root["materials"] =
      json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0.0}}},
                    {"extensions", {{"KHR_materials_unlit", json::object()}}},
                    {"doubleSided", true}}});
  root["textures"] = json::array({{{"source", 0}, {"sampler", 0}}});
  root["samplers"] = json::array({{{"wrapS", 33071}, {"wrapT", 33071}}});
  root["images"] = json::array({{{"bufferView", 3}, {"mimeType", mime}}});
  root["accessors"] =
      json::array({{{"bufferView", 0},
                    {"componentType", float_component},
                    {"count", 4},
                    {"type", "VEC3"},
                    {"min", {-0.5f, -half_height, 0.0f}},
                    {"max", {0.5f, half_height, 0.0f}}},
                   {{"bufferView", 1}, {"componentType", float_component}, {"count", 4}, {"type", "VEC2"}},
                   {{"bufferView", 2}, {"componentType", short_component}, {"count", 6}, {"type", "SCALAR"}}});
  root["bufferViews"] = plane.views;
  root["buffers"] = json::array({{{"byteLength", plane.bytes.size()}}});
  return root;
}

std::vector<std::byte> glb_of(const std::string& text, std::vector<std::byte> binary) {
  std::vector<std::byte> json_bytes;
  append(json_bytes, text.data(), text.size());
  pad(json_bytes, std::byte{' '});
  std::vector<std::byte> glb;
  append(glb, glb_magic);
  append(glb, glb_version);
  append(glb, static_cast<std::uint32_t>(12 + 8 + json_bytes.size() + 8 + binary.size()));
  append(glb, static_cast<std::uint32_t>(json_bytes.size()));
  append(glb, json_chunk);
  append(glb, json_bytes.data(), json_bytes.size());
  append(glb, static_cast<std::uint32_t>(binary.size()));
  append(glb, bin_chunk);
  append(glb, binary.data(), binary.size());
  return glb;
}

}  // namespace

bool is_picture(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

Result<std::vector<std::byte>> image_plane(std::span<const std::byte> picture, const std::filesystem::path& name) {
  const auto decoded = decode_image(picture, name.string());
  if (!decoded) return decoded.fault();
  const float half_height = 0.5f * static_cast<float>(decoded->height_px) / static_cast<float>(decoded->width_px);
  const std::array<float, 12> positions{-0.5f, -half_height, 0.0f, 0.5f,  -half_height, 0.0f,
                                        0.5f,  half_height,  0.0f, -0.5f, half_height,  0.0f};
  const std::array<float, 8> uvs{0.0f, 1.0f, 1.0f, 1.0f, 1.0f, 0.0f, 0.0f, 0.0f};  // glTF counts v from the top
  const std::array<std::uint16_t, 6> indices{0, 1, 2, 0, 2, 3};
  Plane plane;
  plane.add(positions.data(), sizeof positions, array_buffer);
  plane.add(uvs.data(), sizeof uvs, array_buffer);
  plane.add(indices.data(), sizeof indices, index_buffer);
  plane.add(picture.data(), picture.size(), 0);
  const std::string mime = lower_extension(name) == ".png" ? "image/png" : "image/jpeg";
  const json root = describe(plane, half_height, mime, name.stem().string());
  return glb_of(root.dump(-1, ' ', false, json::error_handler_t::replace), std::move(plane.bytes));
}

}  // namespace focalstage
