#include "io/assets/gltf_shape.h"

#include "io/assets/gltf_members.h"
#include "io/assets/mesh_file.h"

namespace focalstage {
namespace {

using Json = MemberChecker::Json;
using Kind = MemberKind;

void check_scene(MemberChecker& check, const Json& root) {
  check.members(root, "", {{"asset", Kind::object, true}, {"scene", Kind::index}});
  check.members(root, "", {{"extensionsUsed", Kind::texts}, {"extensionsRequired", Kind::texts}});
  check.inner(root, "", "asset", {{"version", Kind::text, true}, {"minVersion", Kind::text}});
  check.each(root, "", "scenes", {{"nodes", Kind::indices}});
  check.each(root, "", "nodes",
             {{"children", Kind::indices},
              {"mesh", Kind::index},
              {"skin", Kind::index},
              {"camera", Kind::index},
              {"matrix", Kind::numbers},
              {"translation", Kind::numbers},
              {"rotation", Kind::numbers},
              {"scale", Kind::numbers},
              {"weights", Kind::numbers},
              {"name", Kind::text}},
             [&](const Json& node, const std::string& at) {
               const bool parts = node.contains("translation") || node.contains("rotation") || node.contains("scale");
               if (node.contains("matrix") && parts) check.invalid(at, "a node has both a matrix and its parts");
               check.extension(node, at, "KHR_lights_punctual", {{"light", Kind::index, true}});
             });
}

void check_geometry(MemberChecker& check, const Json& root) {
  check.each(root, "", "meshes",
             {{"primitives", Kind::objects, true}, {"weights", Kind::numbers}, {"name", Kind::text}},
             [&](const Json& mesh, const std::string& at) {
               check.each(mesh, at, "primitives",
                          {{"attributes", Kind::index_map, true},
                           {"indices", Kind::index},
                           {"material", Kind::index},
                           {"mode", Kind::index},
                           {"targets", Kind::index_maps}},
                          [&](const Json& primitive, const std::string& at_primitive) {
                            check.extension(primitive, at_primitive, "KHR_draco_mesh_compression",
                                            {{"bufferView", Kind::index, true}, {"attributes", Kind::index_map, true}});
                          });
             });
  check.each(root, "", "skins",
             {{"joints", Kind::indices, true}, {"inverseBindMatrices", Kind::index}, {"skeleton", Kind::index}});
}

/// Told by the length of its text, before anything is decoded.
void check_inline_size(MemberChecker& check, const Json& buffer, const std::string& at) {
  const auto uri = buffer.find("uri");
  if (uri == buffer.end() || !uri->is_string()) return;
  const std::string_view text = uri->get_ref<const std::string&>();
  constexpr std::string_view mark = ";base64,";
  const std::size_t comma = text.substr(0, 200).find(mark);
  if (!text.starts_with("data:") || comma == std::string_view::npos) return;
  const std::string_view code = text.substr(comma + mark.size());
  const std::size_t padding = code.ends_with("==") ? 2 : code.ends_with('=') ? 1 : 0;
  const std::size_t bytes = code.size() / 4 * 3;
  const auto& announced = buffer.at("byteLength");
  if (!announced.is_number_unsigned() || code.size() % 4 != 0 || bytes < padding) return;
  if (announced.get<std::uint64_t>() != bytes - padding) {
    check.invalid(at + "/uri",
                  "the buffer is " + std::to_string(bytes - padding) + " bytes long and its byteLength differs");
  }
}

void check_data(MemberChecker& check, const Json& root) {
  check.each(
      root, "", "accessors",
      {{"bufferView", Kind::index},
       {"byteOffset", Kind::size},
       {"componentType", Kind::index, true},
       {"normalized", Kind::boolean},
       {"count", Kind::size, true},
       {"type", Kind::text, true},
       {"min", Kind::numbers},
       {"max", Kind::numbers}},
      [&](const Json& accessor, const std::string& at) {
        const Json* sparse = check.inner(accessor, at, "sparse", {{"count", Kind::size, true}});
        if (sparse == nullptr) return;
        check.members(*sparse, at + "/sparse", {{"indices", Kind::object, true}, {"values", Kind::object, true}});
        check.inner(
            *sparse, at + "/sparse", "indices",
            {{"bufferView", Kind::index, true}, {"byteOffset", Kind::size}, {"componentType", Kind::index, true}});
        check.inner(*sparse, at + "/sparse", "values", {{"bufferView", Kind::index, true}, {"byteOffset", Kind::size}});
      });
  check.each(root, "", "bufferViews",
             {{"buffer", Kind::index, true},
              {"byteOffset", Kind::size},
              {"byteLength", Kind::size, true},
              {"byteStride", Kind::size}});
  check.each(root, "", "buffers", {{"uri", Kind::text}, {"byteLength", Kind::size, true}},
             [&](const Json& buffer, const std::string& at) { check_inline_size(check, buffer, at); });
}

void check_materials(MemberChecker& check, const Json& root) {
  check.each(
      root, "", "materials",
      {{"name", Kind::text},
       {"alphaMode", Kind::text},
       {"alphaCutoff", Kind::number},
       {"doubleSided", Kind::boolean},
       {"extensions", Kind::object}},
      [&](const Json& material, const std::string& at) {
        const Json* pbr = check.inner(material, at, "pbrMetallicRoughness", {{"baseColorFactor", Kind::numbers}});
        if (pbr == nullptr) return;
        const std::string at_pbr = at + "/pbrMetallicRoughness";
        const Json* texture =
            check.inner(*pbr, at_pbr, "baseColorTexture", {{"index", Kind::index, true}, {"texCoord", Kind::index}});
        if (texture == nullptr) return;
        check.extension(
            *texture, at_pbr + "/baseColorTexture", "KHR_texture_transform",
            {{"offset", Kind::pair}, {"rotation", Kind::number}, {"scale", Kind::pair}, {"texCoord", Kind::index}});
      });
  check.each(root, "", "textures", {{"sampler", Kind::index}, {"source", Kind::index}, {"extensions", Kind::object}});
  check.each(root, "", "images", {{"uri", Kind::text}, {"bufferView", Kind::index}, {"mimeType", Kind::text}},
             [&](const Json& image, const std::string& at) {
               if (image.contains("uri") == image.contains("bufferView")) {
                 check.invalid(at, "an image has either a uri or a bufferView");
               }
             });
  check.each(root, "", "samplers",
             {{"wrapS", Kind::index}, {"wrapT", Kind::index}, {"magFilter", Kind::index}, {"minFilter", Kind::index}});
}

void check_cameras_and_lights(MemberChecker& check, const Json& root) {
  check.each(root, "", "cameras", {{"type", Kind::text, true}, {"name", Kind::text}},
             [&](const Json& camera, const std::string& at) {
               check.inner(camera, at, "perspective",
                           {{"yfov", Kind::number, true},
                            {"znear", Kind::number, true},
                            {"zfar", Kind::number},
                            {"aspectRatio", Kind::number}});
               check.inner(camera, at, "orthographic",
                           {{"xmag", Kind::number, true},
                            {"ymag", Kind::number, true},
                            {"znear", Kind::number, true},
                            {"zfar", Kind::number, true}});
               const std::string type = camera.at("type").get<std::string>();
               if (type != "perspective" && type != "orthographic") {
                 check.invalid(at + "/type", "glTF has no such camera");
               } else if (!camera.contains(type)) {
                 check.invalid(at + "/" + type, "this member is missing");
               }
             });
  const Json* lights = check.extension(root, "", "KHR_lights_punctual", {{"lights", Kind::objects, true}});
  if (lights == nullptr) return;
  check.each(*lights, "/extensions/KHR_lights_punctual", "lights",
             {{"type", Kind::text, true},
              {"name", Kind::text},
              {"color", Kind::numbers},
              {"intensity", Kind::number},
              {"range", Kind::number},
              {"spot", Kind::object}});
}

void check_channel(MemberChecker& check, const Json& channel, const std::string& at) {
  const Json* target = check.inner(channel, at, "target", {{"node", Kind::index}, {"path", Kind::text, true}});
  if (target == nullptr) return check.invalid(at + "/target", "this member is missing");
  if (!target->contains("node")) {
    check.unsupported(at + "/target", "a channel drives something else than a node", "export node animations only");
  }
}

void check_animations(MemberChecker& check, const Json& root) {
  check.each(root, "", "animations",
             {{"name", Kind::text}, {"channels", Kind::objects, true}, {"samplers", Kind::objects, true}},
             [&](const Json& animation, const std::string& at) {
               check.each(animation, at, "samplers",
                          {{"input", Kind::index, true}, {"output", Kind::index, true}, {"interpolation", Kind::text}});
               check.each(animation, at, "channels", {{"sampler", Kind::index, true}},
                          [&](const Json& channel, const std::string& at_channel) {
                            check_channel(check, channel, at_channel);
                          });
             });
}

}  // namespace

Result<nlohmann::json> check_gltf_shape(std::span<const std::byte> json, const std::string& path) {
  const auto* text = reinterpret_cast<const char*>(json.data());
  try {
    Json root = Json::parse(text, text + json.size());
    if (!root.is_object()) return invalid_asset(path, "the JSON is no object");
    MemberChecker check(path);
    for (const auto part :
         {check_scene, check_geometry, check_data, check_materials, check_cameras_and_lights, check_animations}) {
      part(check, root);
    }
    if (!check.ok()) return check.status().fault();
    return root;
  } catch (const Json::exception& error) {
    return invalid_asset(path, std::string("this is no JSON: ") + error.what());
  }
}

}  // namespace focalstage
