#include "io/assets/gltf_parse.h"

#include <algorithm>
#include <optional>

#include "io/assets/gltf_amended.h"
#include "io/assets/gltf_container.h"
#include "io/assets/gltf_shape.h"
#include "io/assets/gltf_uris.h"

namespace focalstage {
namespace {

/// tinygltf sees no file system: what it asks for comes from the companions, and what they answer is kept here.
struct Served {
  const Companions& companion;
  const CompanionNames& names;
  std::span<const std::byte> glb_buffer;
  std::string path;
  std::uint64_t bytes = 0;
  std::optional<Fault> fault;
};

std::optional<std::span<const std::byte>> serve(Served& served, const std::string& name) {
  if (served.fault) return std::nullopt;
  if (name == glb_buffer_uri) return served.glb_buffer;
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

/// The buffer of a GLB in its binary chunk, which may be longer by its padding.
Result<std::span<const std::byte>> glb_buffer(const GltfText& text, const nlohmann::json& root,
                                              const std::string& path) {
  if (text.binary.empty() || !root.contains("buffers") || root.at("buffers").empty()) return text.binary;
  const nlohmann::json& buffer = root.at("buffers").at(0);
  const auto bytes = buffer.at("byteLength").get<std::size_t>();
  if (buffer.contains("uri")) return text.binary;
  if (bytes == 0 || bytes > text.binary.size()) {
    return invalid_asset(path + ": /buffers/0/byteLength", "the GLB's binary chunk does not hold the buffer");
  }
  return text.binary.first(bytes);
}

Status load(std::string_view text, Served& served, tinygltf::Model& gltf) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_image, nullptr);
  loader.SetFsCallbacks({file_exists, same_path, read_whole_file, write_nothing, &served});
  std::string error;
  std::string warning;
  bool loaded = false;
  try {
    loaded = loader.LoadASCIIFromString(&gltf, &error, &warning, text.data(), static_cast<unsigned>(text.size()), "");
  } catch (const std::bad_alloc&) {
    throw;  // answered in read_mesh_file
  } catch (const std::exception& thrown) {
    error += thrown.what();
  }
  if (served.fault) return *served.fault;
  if (!loaded || !error.empty()) {
    std::replace(error.begin(), error.end(), '\n', ' ');
    return invalid_asset(served.path, "this is no valid glTF: " + error.substr(0, 200));
  }
  return {};
}

}  // namespace

Result<tinygltf::Model> parse_gltf(const FileToRead& file) {
  const Result<GltfText> text = gltf_text(file.bytes, file.path);
  if (!text) return text.fault();
  Result<nlohmann::json> root = check_gltf_shape(text->json, file.path);
  if (!root) return root.fault();
  const Result<CompanionNames> names = companion_names(gltf_uris(*root), file.path);
  if (!names) return names.fault();
  const Result<std::span<const std::byte>> binary = glb_buffer(*text, *root, file.path);
  if (!binary) return binary.fault();
  const AmendedGltf amended(*root, !text->binary.empty());
  const std::string changed = amended.changed() ? root->dump() : std::string();
  const std::string_view own(reinterpret_cast<const char*>(text->json.data()), text->json.size());
  *root = nullptr;  // large texts need not be held twice
  Served served{file.companion, *names, *binary, file.path, 0, std::nullopt};
  tinygltf::Model gltf;
  if (Status loaded = load(amended.changed() ? std::string_view(changed) : own, served, gltf); !loaded) {
    return loaded.fault();
  }
  amended.restore(gltf);
  return gltf;
}

}  // namespace focalstage
