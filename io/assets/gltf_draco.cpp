#include "io/assets/gltf_draco.h"

#include <cstring>
#include <limits>
#include <map>
#include <tuple>

#include <draco/compression/decode.h>

#include "io/assets/gltf_check.h"
#include "io/assets/mesh_file.h"

namespace focalstage {
namespace {

constexpr const char* extension_name = "KHR_draco_mesh_compression";

/// What a primitive says of its compressed data.
struct Compressed {
  int view = -1;
  std::map<std::string, int> attributes;  ///< to the ids that Draco gives them

  auto operator<=>(const Compressed&) const = default;
};

Compressed compressed_from(const tinygltf::Value& extension) {
  Compressed compressed;
  compressed.view = extension.Get("bufferView").GetNumberAsInt();
  const tinygltf::Value& attributes = extension.Get("attributes");
  for (const std::string& name : attributes.Keys()) {
    compressed.attributes[name] = attributes.Get(name).GetNumberAsInt();
  }
  return compressed;
}

template <class Number>
void put_number(std::vector<unsigned char>& data, Number number) {
  unsigned char raw[sizeof(Number)];
  std::memcpy(raw, &number, sizeof(Number));
  data.insert(data.end(), raw, raw + sizeof(Number));
}

/// All values of an attribute, point by point, as numbers of this type.
template <class Number>
bool values_of(const draco::Mesh& mesh, const draco::PointAttribute& attribute, std::vector<unsigned char>& data) {
  const auto components = static_cast<std::int8_t>(attribute.num_components());
  Number values[std::numeric_limits<std::int8_t>::max()] = {};
  for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
    if (!attribute.ConvertValue<Number>(attribute.mapped_index(point), components, values)) return false;
    for (int k = 0; k < components; ++k) put_number(data, values[k]);
  }
  return true;
}

bool values_as(int component_type, const draco::Mesh& mesh, const draco::PointAttribute& attribute,
               std::vector<unsigned char>& data) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return values_of<std::int8_t>(mesh, attribute, data);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return values_of<std::uint8_t>(mesh, attribute, data);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return values_of<std::int16_t>(mesh, attribute, data);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return values_of<std::uint16_t>(mesh, attribute, data);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return values_of<std::uint32_t>(mesh, attribute, data);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return values_of<float>(mesh, attribute, data);
    default:
      return false;
  }
}

class DracoReader {
 public:
  DracoReader(tinygltf::Model& gltf, const std::string& path) : gltf_(gltf), path_(path) {}

  Status read(tinygltf::Primitive& primitive, const std::string& where) {
    const auto found = primitive.extensions.find(extension_name);
    if (found == primitive.extensions.end()) return {};
    where_ = where + "/extensions/" + extension_name;
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES) {
      return unsupported_asset(where + "/mode", "compressed strips are not read", "export triangles");
    }
    const Compressed compressed = compressed_from(found->second);
    // Primitives that say the same share what they are given.
    auto& known = known_[{compressed, primitive.attributes, primitive.indices}];
    if (known.first.empty()) {
      if (Status status = unpack(compressed, primitive); !status) return status;
      known = {primitive.attributes, primitive.indices};
    }
    primitive.attributes = known.first;
    primitive.indices = known.second;
    return {};
  }

 private:
  Status unpack(const Compressed& compressed, tinygltf::Primitive& primitive) {
    if (!is_one_of(compressed.view, gltf_.bufferViews.size())) {
      return invalid_asset(where_ + "/bufferView", "there is no such bufferView");
    }
    const std::span<const std::byte> bytes = view_bytes(gltf_, compressed.view);
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    const auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) return invalid_asset(where_, "these are no data that Draco compressed");
    const draco::Mesh& mesh = *decoded.value();
    if (mesh.num_points() > most_vertices || mesh.num_faces() > most_vertices) {
      return Fault{"asset.too-large", where_, "it holds more than 2^24 vertices or triangles", "simplify the mesh"};
    }
    for (const auto& [name, id] : compressed.attributes) {
      if (Status status = unpack_attribute(mesh, name, id, primitive); !status) return status;
    }
    return unpack_indices(mesh, primitive);
  }

  Status unpack_attribute(const draco::Mesh& mesh, const std::string& name, int id, tinygltf::Primitive& primitive) {
    const std::string where = where_ + "/attributes/" + name.substr(0, 60);
    const auto named = primitive.attributes.find(name);
    if (named == primitive.attributes.end() || !is_one_of(named->second, gltf_.accessors.size())) {
      return invalid_asset(where, "the primitive has no such attribute");
    }
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
    if (attribute == nullptr) return invalid_asset(where, "the compressed data have no attribute of this id");
    const tinygltf::Accessor& accessor = gltf_.accessors[static_cast<std::size_t>(named->second)];
    const auto components = static_cast<std::size_t>(attribute->num_components());
    if (accessor.count != mesh.num_points() || accessor.type < 0 || component_count(accessor.type) != components ||
        components > 4) {
      return invalid_asset(where, "its accessor has another count or type than the compressed data");
    }
    if (Status status = take(accessor); !status) return status;
    std::vector<unsigned char> data;
    if (!values_as(accessor.componentType, mesh, *attribute, data)) {
      return invalid_asset(where, "its values do not fit its accessor's component type");
    }
    named->second = add_accessor(accessor, std::move(data));
    return {};
  }

  Status unpack_indices(const draco::Mesh& mesh, tinygltf::Primitive& primitive) {
    if (!is_one_of(primitive.indices, gltf_.accessors.size())) {
      return invalid_asset(where_, "a compressed primitive has indices");
    }
    tinygltf::Accessor accessor = gltf_.accessors[static_cast<std::size_t>(primitive.indices)];
    if (accessor.count != std::size_t{3} * mesh.num_faces() || accessor.type != TINYGLTF_TYPE_SCALAR) {
      return invalid_asset(where_, "its indices have another count than the compressed data");
    }
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (Status status = take(accessor); !status) return status;
    std::vector<unsigned char> data;
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
      for (const draco::PointIndex& corner : mesh.face(face)) put_number(data, std::uint32_t{corner.value()});
    }
    primitive.indices = add_accessor(accessor, std::move(data));
    return {};
  }

  /// Many primitives may ask for the same compressed data under other names: what comes of them is bounded.
  Status take(const tinygltf::Accessor& accessor) {
    bytes_ += accessor.count * component_count(accessor.type) * sizeof(float);
    if (bytes_ <= most_file_bytes) return {};
    return Fault{"asset.too-large", where_, "the compressed data hold more than 512 MiB", "simplify the meshes"};
  }

  int add_accessor(tinygltf::Accessor accessor, std::vector<unsigned char> data) {
    tinygltf::BufferView view;
    view.buffer = static_cast<int>(gltf_.buffers.size());
    view.byteLength = data.size();
    accessor.bufferView = static_cast<int>(gltf_.bufferViews.size());
    accessor.byteOffset = 0;
    accessor.sparse.isSparse = false;
    accessor.minValues.clear();  // of what was compressed, which quantizing moved
    accessor.maxValues.clear();
    gltf_.buffers.emplace_back().data = std::move(data);
    gltf_.bufferViews.push_back(view);
    gltf_.accessors.push_back(std::move(accessor));
    return static_cast<int>(gltf_.accessors.size()) - 1;
  }

  using Key = std::tuple<Compressed, std::map<std::string, int>, int>;
  tinygltf::Model& gltf_;
  std::string path_;
  std::string where_;  ///< the extension at hand
  std::map<Key, std::pair<std::map<std::string, int>, int>> known_;
  std::size_t bytes_ = 0;
};

}  // namespace

Status decode_gltf_draco(tinygltf::Model& gltf, const std::string& path) {
  DracoReader reader(gltf, path);
  for (std::size_t i = 0; i < gltf.meshes.size(); ++i) {
    std::vector<tinygltf::Primitive>& primitives = gltf.meshes[i].primitives;
    for (std::size_t k = 0; k < primitives.size(); ++k) {
      const std::string where = path + ": /meshes/" + std::to_string(i) + "/primitives/" + std::to_string(k);
      if (Status status = reader.read(primitives[k], where); !status) return status;
    }
  }
  return {};
}

}  // namespace focalstage
