#include "io/assets/gltf_amended.h"

namespace focalstage {
namespace {

using Json = nlohmann::json;

/// Null where there is none.
Json* list_in(Json& object, const char* name) {
  const auto found = object.find(name);
  return found == object.end() ? nullptr : &*found;
}

/// Does `work(item, index)` to each of a list.
template <class Work>
void for_each_in(Json& object, const char* name, Work&& work) {
  Json* list = list_in(object, name);
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) work((*list)[i], i);
}

}  // namespace

AmendedGltf::AmendedGltf(Json& root, bool has_binary) {
  for_each_in(root, "buffers", [&](Json& buffer, std::size_t i) {
    if (i > 0 || !has_binary || buffer.contains("uri")) return;
    buffer["uri"] = glb_buffer_uri;
    changed_ = true;
  });
  take_binds(root);
  take_indices(root);
}

void AmendedGltf::take_binds(Json& root) {
  for_each_in(root, "skins", [&](Json& skin, std::size_t i) {
    if (skin.contains("inverseBindMatrices")) return;
    skin["inverseBindMatrices"] = 0;
    skins_without_binds_.push_back(i);
    changed_ = true;
  });
}

void AmendedGltf::take_indices(Json& root) {
  const Json* accessors = list_in(root, "accessors");
  if (accessors == nullptr) return;
  for_each_in(root, "meshes", [&](Json& mesh, std::size_t of_mesh) {
    for_each_in(mesh, "primitives", [&](Json& primitive, std::size_t i) {
      const auto indices = primitive.find("indices");
      if (indices == primitive.end()) return;
      const auto accessor = indices->get<std::size_t>();
      if (accessor >= accessors->size() || (*accessors)[accessor].contains("bufferView")) return;
      indices_.push_back({of_mesh, i, static_cast<int>(accessor)});
      primitive.erase(indices);
      changed_ = true;
    });
  });
}

void AmendedGltf::restore(tinygltf::Model& gltf) const {
  for (const Indices& taken : indices_) gltf.meshes[taken.mesh].primitives[taken.primitive].indices = taken.accessor;
  for (const std::size_t skin : skins_without_binds_) gltf.skins[skin].inverseBindMatrices = -1;
}

std::vector<std::string> gltf_uris(const Json& root) {
  std::vector<std::string> uris;
  for (const char* list : {"buffers", "images"}) {
    if (!root.contains(list)) continue;
    for (const Json& item : root.at(list)) {
      if (item.contains("uri")) uris.push_back(item.at("uri").get<std::string>());
    }
  }
  return uris;
}

}  // namespace focalstage
