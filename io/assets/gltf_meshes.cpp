#include "io/assets/gltf_meshes.h"

#include <map>
#include <tuple>

namespace focalstage {
namespace {

/// The accessors a mesh is made of; -1 for none.
struct Sources {
  int mode = 0;
  int indices = -1;
  int position = -1;
  int normal = -1;
  int uv = -1;

  auto operator<=>(const Sources&) const = default;
};

/// The corners of a strip or fan as those of its triangles (glTF 2.0, 3.7.2.1).
std::vector<glm::uvec3> triangles_from(const std::vector<std::uint32_t>& corners, int mode) {
  std::vector<glm::uvec3> triangles;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    triangles.reserve(corners.size() / 3);
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
    }
    return triangles;
  }
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
      triangles.emplace_back(corners[i + 1], corners[i + 2], corners[0]);
    } else {
      triangles.emplace_back(corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]);
    }
  }
  return triangles;
}

class MeshReader {
 public:
  MeshReader(const GltfDocument& document, const GltfMaterials& materials)
      : document_(document), materials_(materials) {}

  Result<GltfMeshes> read() {
    for (std::size_t i = 0; i < document_.gltf.meshes.size(); ++i) {
      const tinygltf::Mesh& mesh = document_.gltf.meshes[i];
      const std::string where = document_.at("meshes", i);
      if (mesh.primitives.empty()) return invalid_asset(where, "a mesh has at least one primitive");
      std::vector<ModelPart>& parts = result_.parts_of_mesh.emplace_back();
      for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
        Result<ModelPart> part = read_primitive(mesh.primitives[k], where + "/primitives/" + std::to_string(k));
        if (!part) return part.fault();
        parts.push_back(*std::move(part));
      }
    }
    return std::move(result_);
  }

 private:
  Result<ModelPart> read_primitive(const tinygltf::Primitive& primitive, const std::string& where) {
    if (!primitive.targets.empty()) {
      return unsupported_asset(where + "/targets", "morph targets are not read", "export without shape keys");
    }
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
      return invalid_asset(where + "/mode", "glTF has no such mode");
    }
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
      return unsupported_asset(where + "/mode", "points and lines are not drawn", "export triangles only");
    }
    if (primitive.material >= static_cast<int>(materials_.materials.size())) {
      return invalid_asset(where + "/material", "there is no such material");
    }
    const int uv_set = primitive.material < 0 ? -1 : materials_.uv_set[static_cast<std::size_t>(primitive.material)];
    Result<Sources> sources = find_sources(primitive, uv_set, where);
    if (!sources) return sources.fault();
    std::shared_ptr<const Mesh>& known = meshes_[*sources];
    if (!known) {
      Result<Mesh> mesh = read_mesh(*sources, where);
      if (!mesh) return mesh.fault();
      known = std::make_shared<const Mesh>(*std::move(mesh));
    }
    return ModelPart{known, primitive.material};
  }

  Result<Sources> find_sources(const tinygltf::Primitive& primitive, int uv_set, const std::string& where) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return invalid_asset(where + "/attributes", "there is no POSITION");
    const tinygltf::Accessor* first = accessor_at(document_, position->second);
    for (const auto& [name, index] : primitive.attributes) {
      const tinygltf::Accessor* accessor = accessor_at(document_, index);
      if (accessor == nullptr) return invalid_asset(where + "/attributes/" + name, "there is no such accessor");
      if (first == nullptr || accessor->count != first->count) {
        return invalid_asset(where + "/attributes/" + name, "its count differs from POSITION's");
      }
    }
    const std::string uv_name = "TEXCOORD_" + std::to_string(uv_set < 0 ? 0 : uv_set);
    Sources sources;
    sources.mode = primitive.mode;
    sources.indices = primitive.indices;
    sources.position = position->second;
    const auto attribute = [&](const std::string& name) {
      const auto found = primitive.attributes.find(name);
      return found == primitive.attributes.end() ? -1 : found->second;
    };
    sources.normal = attribute("NORMAL");
    sources.uv = attribute(uv_name);
    if (uv_set >= 0 && sources.uv < 0) {
      return invalid_asset(where + "/attributes", "its material's texture needs " + uv_name);
    }
    if (attribute("COLOR_0") >= 0) {
      result_.findings.push_back(asset_finding(Severity::info, "asset.colors", where, "vertex colours are left out"));
    }
    if (Status status = check_types(sources, where); !status) return status.fault();
    return sources;
  }

  Status check_types(const Sources& sources, const std::string& where) {
    const auto is_float = [](const tinygltf::Accessor& a) { return a.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT; };
    const tinygltf::Accessor& position = *accessor_at(document_, sources.position);
    if (position.type != TINYGLTF_TYPE_VEC3 || !is_float(position)) {
      return invalid_asset(where + "/attributes/POSITION", "positions are vectors of three floats");
    }
    if (sources.normal >= 0) {
      const tinygltf::Accessor& normal = *accessor_at(document_, sources.normal);
      if (normal.type != TINYGLTF_TYPE_VEC3 || !is_float(normal)) {
        return invalid_asset(where + "/attributes/NORMAL", "normals are vectors of three floats");
      }
    }
    if (sources.uv >= 0) {
      const tinygltf::Accessor& uv = *accessor_at(document_, sources.uv);
      const bool unsigned_fraction = uv.normalized && (uv.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                                                       uv.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
      if (uv.type != TINYGLTF_TYPE_VEC2 || !(is_float(uv) || unsigned_fraction)) {
        return invalid_asset(where + "/attributes", "texture coordinates are pairs of floats or unsigned fractions");
      }
    }
    if (sources.indices < 0) return {};
    const tinygltf::Accessor* indices = accessor_at(document_, sources.indices);
    if (indices == nullptr) return invalid_asset(where + "/indices", "there is no such accessor");
    const bool whole = indices->componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                       indices->componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                       indices->componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (indices->type != TINYGLTF_TYPE_SCALAR || !whole || indices->normalized ||
        document_.gltf.bufferViews[static_cast<std::size_t>(indices->bufferView)].byteStride != 0) {
      return invalid_asset(where + "/indices", "indices are packed unsigned integers");
    }
    return {};
  }

  Result<std::vector<std::uint32_t>> read_corners(const Sources& sources, std::size_t vertices,
                                                  const std::string& where) {
    std::vector<std::uint32_t> corners;
    if (sources.indices >= 0) {
      corners = read_integers(document_, sources.indices);
    } else {
      corners.resize(vertices);
      for (std::size_t i = 0; i < vertices; ++i) corners[i] = static_cast<std::uint32_t>(i);
    }
    for (const std::uint32_t corner : corners) {
      if (corner >= vertices) return invalid_asset(where + "/indices", "an index names no vertex");
    }
    if (corners.size() < 3 || (sources.mode == TINYGLTF_MODE_TRIANGLES && corners.size() % 3 != 0)) {
      return invalid_asset(where, "its corners make no whole triangles");
    }
    return corners;
  }

  Result<Mesh> read_mesh(const Sources& sources, const std::string& where) {
    const tinygltf::Accessor* indices = accessor_at(document_, sources.indices);
    const std::size_t vertices = accessor_at(document_, sources.position)->count;
    // Before anything is allocated; a strip has almost as many triangles as corners.
    const std::size_t corner_count = indices == nullptr ? vertices : indices->count;
    const std::size_t most_corners = 3 * most_vertices;
    if (result_.vertices + vertices > most_vertices || 3 * result_.triangles + corner_count > most_corners) {
      return Fault{"asset.too-large", where, "the file holds more than 2^24 vertices or triangles",
                   "simplify the meshes"};
    }
    result_.vertices += vertices;
    Mesh mesh;
    const Result<std::vector<glm::dvec4>> positions = read_vectors(document_, sources.position);
    if (!positions) return positions.fault();
    for (const glm::dvec4& p : *positions) mesh.positions_m.emplace_back(p);
    if (sources.normal >= 0) {
      const Result<std::vector<glm::dvec4>> normals = read_vectors(document_, sources.normal);
      if (!normals) return normals.fault();
      for (const glm::dvec4& n : *normals) mesh.normals.emplace_back(n);
      if (!make_normals_unit(mesh)) {
        result_.findings.push_back(
            asset_finding(Severity::warning, "asset.normals", where, "a normal has no length; faces are lit flat"));
      }
    }
    if (sources.uv >= 0) {
      const Result<std::vector<glm::dvec4>> uvs = read_vectors(document_, sources.uv);
      if (!uvs) return uvs.fault();
      for (const glm::dvec4& uv : *uvs) mesh.uvs.emplace_back(uv.x, 1.0 - uv.y);  // glTF counts from the upper edge
    }
    const Result<std::vector<std::uint32_t>> corners = read_corners(sources, mesh.positions_m.size(), where);
    if (!corners) return corners.fault();
    mesh.triangles = triangles_from(*corners, sources.mode);
    result_.triangles += mesh.triangles.size();
    return mesh;
  }

  const GltfDocument& document_;
  const GltfMaterials& materials_;
  GltfMeshes result_;
  std::map<Sources, std::shared_ptr<const Mesh>> meshes_;
};

}  // namespace

Result<GltfMeshes> read_gltf_meshes(const GltfDocument& document, const GltfMaterials& materials) {
  return MeshReader(document, materials).read();
}

}  // namespace focalstage
