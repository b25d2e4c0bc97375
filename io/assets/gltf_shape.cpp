#include "io/assets/gltf_shape.h"

#include <nlohmann/json.hpp>

#include "io/assets/mesh_file.h"

namespace focalstage {
namespace {

using Json = nlohmann::json;

/// What a member must be. Indices and sizes fit an int, into which tinygltf reads them.
enum class Kind { index, size, number, boolean, text, object, indices, numbers, texts, objects, index_map };

struct Member {
  const char* name;
  Kind kind;
  bool required = false;
};

constexpr std::size_t most_items = 65536;  ///< of one list

using Members = std::initializer_list<Member>;

bool is_index(const Json& value) { return value.is_number_unsigned() && value.get<std::uint64_t>() <= 0x7FFFFFFFu; }

template <class Test>
bool all(const Json& value, Test&& test) {
  for (const Json& item : value) {
    if (!test(item)) return false;
  }
  return true;
}

bool is_a(const Json& value, Kind kind) {
  switch (kind) {
    case Kind::index:
    case Kind::size:
      return is_index(value);
    case Kind::number:
      return value.is_number();
    case Kind::boolean:
      return value.is_boolean();
    case Kind::text:
      return value.is_string();
    case Kind::object:
      return value.is_object();
    case Kind::indices:
      return value.is_array() && all(value, is_index);
    case Kind::numbers:
      return value.is_array() && all(value, [](const Json& n) { return n.is_number(); });
    case Kind::texts:
      return value.is_array() && all(value, [](const Json& t) { return t.is_string(); });
    case Kind::objects:
      return value.is_array() && all(value, [](const Json& o) { return o.is_object(); });
    case Kind::index_map:
      return value.is_object() && all(value, is_index);
  }
  return false;
}

class ShapeChecker {
 public:
  explicit ShapeChecker(std::string path) : path_(std::move(path)) {}

  Status check(const Json& root) {
    members(root, "",
            {{"asset", Kind::object, true},
             {"scene", Kind::index},
             {"scenes", Kind::objects},
             {"nodes", Kind::objects},
             {"meshes", Kind::objects},
             {"accessors", Kind::objects},
             {"bufferViews", Kind::objects},
             {"buffers", Kind::objects},
             {"materials", Kind::objects},
             {"textures", Kind::objects},
             {"images", Kind::objects},
             {"samplers", Kind::objects},
             {"animations", Kind::objects},
             {"skins", Kind::objects},
             {"extensionsUsed", Kind::texts},
             {"extensionsRequired", Kind::texts}});
    const Json* skins = find(root, "skins");
    if (fault_.ok() && skins != nullptr && !skins->empty()) {
      fault_ = unsupported_asset(path_ + ": /skins", "skins are not read", "bake the animation into the nodes");
    }
    if (fault_.ok()) scene(root);
    if (fault_.ok()) geometry(root);
    if (fault_.ok()) materials(root);
    if (fault_.ok()) animations(root);
    return fault_;
  }

 private:
  void scene(const Json& root) {
    members(root.at("asset"), "/asset", {{"version", Kind::text, true}, {"minVersion", Kind::text}});
    each(root, "", "scenes", {{"nodes", Kind::indices}});
    each(root, "", "nodes",
         {{"children", Kind::indices},
          {"mesh", Kind::index},
          {"skin", Kind::index},
          {"matrix", Kind::numbers},
          {"translation", Kind::numbers},
          {"rotation", Kind::numbers},
          {"scale", Kind::numbers},
          {"weights", Kind::numbers},
          {"name", Kind::text}},
         [&](const Json& node, const std::string& at) {
           const bool parts = node.contains("translation") || node.contains("rotation") || node.contains("scale");
           if (node.contains("matrix") && parts) {
             fault_ = invalid_asset(path_ + ": " + at, "a node has both a matrix and its parts");
           }
         });
  }

  void geometry(const Json& root) {
    each(root, "", "meshes", {{"primitives", Kind::objects, true}, {"weights", Kind::numbers}, {"name", Kind::text}},
         [&](const Json& mesh, const std::string& at) {
           each(mesh, at, "primitives",
                {{"attributes", Kind::index_map, true},
                 {"indices", Kind::index},
                 {"material", Kind::index},
                 {"mode", Kind::index},
                 {"targets", Kind::objects},
                 {"extensions", Kind::object}});
         });
    each(root, "", "accessors",
         {{"bufferView", Kind::index},
          {"byteOffset", Kind::size},
          {"componentType", Kind::index, true},
          {"normalized", Kind::boolean},
          {"count", Kind::size, true},
          {"type", Kind::text, true},
          {"sparse", Kind::object}});
    each(root, "", "bufferViews",
         {{"buffer", Kind::index, true},
          {"byteOffset", Kind::size},
          {"byteLength", Kind::size, true},
          {"byteStride", Kind::size}});
    each(root, "", "buffers", {{"uri", Kind::text}, {"byteLength", Kind::size, true}});
  }

  void materials(const Json& root) {
    each(root, "", "materials",
         {{"name", Kind::text},
          {"pbrMetallicRoughness", Kind::object},
          {"alphaMode", Kind::text},
          {"alphaCutoff", Kind::number},
          {"doubleSided", Kind::boolean},
          {"extensions", Kind::object}},
         [&](const Json& material, const std::string& at) {
           const Json* pbr = find(material, "pbrMetallicRoughness");
           if (pbr == nullptr) return;
           const std::string at_pbr = at + "/pbrMetallicRoughness";
           members(*pbr, at_pbr, {{"baseColorFactor", Kind::numbers}, {"baseColorTexture", Kind::object}});
           const Json* texture = find(*pbr, "baseColorTexture");
           if (!fault_.ok() || texture == nullptr) return;
           members(*texture, at_pbr + "/baseColorTexture",
                   {{"index", Kind::index, true}, {"texCoord", Kind::index}, {"extensions", Kind::object}});
         });
    each(root, "", "textures", {{"sampler", Kind::index}, {"source", Kind::index}, {"extensions", Kind::object}});
    each(root, "", "images", {{"uri", Kind::text}, {"bufferView", Kind::index}, {"mimeType", Kind::text}},
         [&](const Json& image, const std::string& at) {
           if (image.contains("uri") == image.contains("bufferView")) {
             fault_ = invalid_asset(path_ + ": " + at, "an image has either a uri or a bufferView");
           }
         });
    each(root, "", "samplers", {{"wrapS", Kind::index}, {"wrapT", Kind::index}});
  }

  void animations(const Json& root) {
    each(root, "", "animations",
         {{"name", Kind::text}, {"channels", Kind::objects, true}, {"samplers", Kind::objects, true}},
         [&](const Json& animation, const std::string& at) {
           each(animation, at, "samplers",
                {{"input", Kind::index, true}, {"output", Kind::index, true}, {"interpolation", Kind::text}});
           each(animation, at, "channels", {{"sampler", Kind::index, true}, {"target", Kind::object, true}},
                [&](const Json& channel, const std::string& at_channel) {
                  const std::string at_target = at_channel + "/target";
                  const Json& target = channel.at("target");
                  members(target, at_target, {{"node", Kind::index}, {"path", Kind::text, true}});
                  if (fault_.ok() && !target.contains("node")) {
                    fault_ = unsupported_asset(path_ + ": " + at_target, "a channel drives something else than a node",
                                               "export node animations only");
                  }
                });
         });
  }

  static const Json* find(const Json& object, const char* name) {
    const auto found = object.find(name);
    return found == object.end() ? nullptr : &*found;
  }

  void members(const Json& object, const std::string& at, Members expected) {
    for (const Member& member : expected) {
      const Json* value = find(object, member.name);
      if (value == nullptr ? member.required : !is_a(*value, member.kind)) {
        fault_ = invalid_asset(path_ + ": " + at + "/" + member.name,
                               value == nullptr ? "this member is missing" : "this member is not of glTF's type");
        return;
      }
    }
  }

  void each(const Json& parent, const std::string& at, const char* list, Members expected) {
    each(parent, at, list, expected, [](const Json&, const std::string&) {});
  }

  template <class Inner>
  void each(const Json& parent, const std::string& at, const char* list, Members expected, Inner&& inner) {
    const Json* items = find(parent, list);
    if (items == nullptr) return;
    if (items->size() > most_items) fault_ = invalid_asset(path_ + ": " + at + "/" + list, "more than 65536 items");
    for (std::size_t i = 0; i < items->size() && fault_.ok(); ++i) {
      const std::string at_item = at + "/" + list + "/" + std::to_string(i);
      members((*items)[i], at_item, expected);
      if (fault_.ok()) inner((*items)[i], at_item);
    }
  }

  std::string path_;
  Status fault_;
};

std::vector<std::string> uris_of(const Json& root) {
  std::vector<std::string> uris;
  for (const char* list : {"buffers", "images"}) {
    if (!root.contains(list)) continue;
    for (const Json& item : root.at(list)) {
      if (item.contains("uri")) uris.push_back(item.at("uri").get<std::string>());
    }
  }
  return uris;
}

}  // namespace

Result<std::vector<std::string>> check_gltf_shape(std::span<const std::byte> json, const std::string& path) {
  const auto* text = reinterpret_cast<const char*>(json.data());
  try {
    const Json root = Json::parse(text, text + json.size());
    if (!root.is_object()) return invalid_asset(path, "the JSON is no object");
    if (Status shape = ShapeChecker(path).check(root); !shape) return shape.fault();
    return uris_of(root);
  } catch (const Json::exception& error) {
    return invalid_asset(path, std::string("this is no JSON: ") + error.what());
  }
}

}  // namespace focalstage
