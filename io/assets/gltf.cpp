#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include <tiny_gltf.h>

#include "io/assets/gltf_accessors.h"
#include "io/assets/gltf_animations.h"
#include "io/assets/gltf_container.h"
#include "io/assets/gltf_materials.h"
#include "io/assets/gltf_meshes.h"
#include "io/assets/gltf_nodes.h"
#include "io/assets/gltf_shape.h"
#include "io/assets/gltf_uris.h"
#include "io/assets/mesh_file.h"

namespace focalstage {
namespace {

/// tinygltf sees no file system: what it asks for comes from the companions, and what they answer is kept here.
struct Served {
  const Companions& companion;
  const CompanionNames& names;
  std::string path;
  std::uint64_t bytes = 0;
  std::optional<Fault> fault;
};

std::optional<std::span<const std::byte>> serve(Served& served, const std::string& name) {
  if (served.fault) return std::nullopt;
  const auto known = served.names.find(name);
  if (known == served.names.end()) {
    served.fault = unsupported_asset(served.path, "this is no reference to a file: " + name.substr(0, 60),
                                     "refer to a file beside this one");
    return std::nullopt;
  }
  const Result<std::span<const std::byte>> bytes = served.companion(known->second);
  if (!bytes) {
    served.fault = bytes.fault();
    return std::nullopt;
  }
  return *bytes;
}

bool file_exists(const std::string& name, void* user) { return serve(*static_cast<Served*>(user), name).has_value(); }

std::string same_path(const std::string& name, void*) { return name; }

bool read_whole_file(std::vector<unsigned char>* out, std::string*, const std::string& name, void* user) {
  auto& served = *static_cast<Served*>(user);
  const auto bytes = serve(served, name);
  if (!bytes) return false;
  served.bytes += bytes->size();
  if (served.bytes > most_file_bytes) {
    served.fault =
        Fault{"asset.too-large", served.path, "its buffers and images are over 512 MiB together", "use smaller ones"};
    return false;
  }
  const auto* from = reinterpret_cast<const unsigned char*>(bytes->data());
  out->assign(from, from + bytes->size());
  return true;
}

bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }

/// Keeps the bytes of an image outside the buffers; one in a bufferView is found there once views are checked. The
/// pointer tinygltf passes for such a one is not, and must not be touched.
bool keep_image(tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
                int size, void*) {
  if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
  return true;
}

Status check_extensions(const tinygltf::Model& gltf, const std::string& path) {
  // These change what other members mean: not even a file that only "uses" them is what it seems.
  constexpr std::array<std::string_view, 4> changing{"KHR_draco_mesh_compression", "KHR_mesh_quantization",
                                                     "EXT_meshopt_compression", "EXT_mesh_gpu_instancing"};
  constexpr std::array<std::string_view, 2> known{"KHR_materials_unlit", "KHR_texture_transform"};
  for (const std::string& used : gltf.extensionsUsed) {
    if (std::find(changing.begin(), changing.end(), used) != changing.end()) {
      return unsupported_asset(path + ": /extensionsUsed", used + " is not read", "export without it");
    }
  }
  for (const std::string& required : gltf.extensionsRequired) {
    if (std::find(known.begin(), known.end(), required) == known.end()) {
      return unsupported_asset(path + ": /extensionsRequired", required.substr(0, 60) + " is not read",
                               "export without it");
    }
  }
  return {};
}

Status check_whole(const tinygltf::Model& gltf, const std::string& path) {
  const std::string& version = gltf.asset.version;
  if (version != "2.0" && !version.starts_with("2.")) {
    return unsupported_asset(path + ": /asset/version", "only glTF 2.0 is read", "export it as glTF 2.0");
  }
  if (!gltf.asset.minVersion.empty() && gltf.asset.minVersion != "2.0") {
    return unsupported_asset(path + ": /asset/minVersion", "only glTF 2.0 is read", "export it as glTF 2.0");
  }
  for (std::size_t i = 0; i < gltf.meshes.size(); ++i) {
    if (!gltf.meshes[i].weights.empty()) {
      return unsupported_asset(path + ": /meshes/" + std::to_string(i) + "/weights", "morph targets are not read",
                               "export without shape keys");
    }
  }
  return check_extensions(gltf, path);
}

/// What tinygltf makes of the bytes, or why nothing.
Status parse(const FileToRead& file, bool glb, const CompanionNames& names, tinygltf::Model& gltf) {
  Served served{file.companion, names, file.path, 0, std::nullopt};
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_image, nullptr);
  loader.SetFsCallbacks({file_exists, same_path, read_whole_file, write_nothing, &served});
  std::string error;
  std::string warning;
  bool loaded = false;
  const auto size = static_cast<unsigned>(file.bytes.size());
  try {
    if (glb) {
      const auto* bytes = reinterpret_cast<const unsigned char*>(file.bytes.data());
      loaded = loader.LoadBinaryFromMemory(&gltf, &error, &warning, bytes, size, "");
    } else {
      const auto* text = reinterpret_cast<const char*>(file.bytes.data());
      loaded = loader.LoadASCIIFromString(&gltf, &error, &warning, text, size, "");
    }
  } catch (const std::bad_alloc&) {
    throw;  // answered in read_mesh_file
  } catch (const std::exception& thrown) {
    error += thrown.what();
  }
  if (served.fault) return *served.fault;
  if (!loaded || !error.empty()) {
    std::replace(error.begin(), error.end(), '\n', ' ');
    return invalid_asset(file.path, "this is no valid glTF: " + error.substr(0, 200));
  }
  return {};
}

}  // namespace

Result<MeshFile> read_gltf(const FileToRead& file) {
  const Result<GltfText> text = gltf_text(file.bytes, file.path);
  if (!text) return text.fault();
  const Result<std::vector<std::string>> uris = check_gltf_shape(text->json, file.path);
  if (!uris) return uris.fault();
  const Result<CompanionNames> names = companion_names(*uris, file.path);
  if (!names) return names.fault();
  tinygltf::Model gltf;
  if (Status parsed = parse(file, text->glb, *names, gltf); !parsed) return parsed.fault();
  const GltfDocument document{gltf, file.path};
  if (Status whole = check_whole(gltf, file.path); !whole) return whole.fault();
  if (Status buffers = check_gltf_buffers(document); !buffers) return buffers.fault();
  Result<GltfMaterials> materials = read_gltf_materials(document);
  if (!materials) return materials.fault();
  Result<GltfMeshes> meshes = read_gltf_meshes(document, *materials);
  if (!meshes) return meshes.fault();
  Result<GltfNodes> nodes = read_gltf_nodes(document, meshes->parts_of_mesh);
  if (!nodes) return nodes.fault();
  Result<std::vector<Animation>> animations = read_gltf_animations(document, *nodes);
  if (!animations) return animations.fault();

  MeshFile result;
  result.vertices = meshes->vertices;
  result.triangles = meshes->triangles;
  for (const auto& findings : {materials->findings, meshes->findings, nodes->findings}) {
    result.findings.insert(result.findings.end(), findings.begin(), findings.end());
  }
  if (std::none_of(nodes->nodes.begin(), nodes->nodes.end(), [](const Node& n) { return !n.parts.empty(); })) {
    result.findings.push_back(asset_finding(Severity::warning, "asset.empty", file.path, "the scene draws nothing"));
  }
  result.model = {std::move(materials->materials), std::move(nodes->nodes), *std::move(animations)};
  return result;
}

}  // namespace focalstage
