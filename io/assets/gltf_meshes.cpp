#include "io/assets/gltf_meshes.h"

#include <map>
#include <numeric>

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
      std::vector<ModelPart>& parts = result_.parts_of_mesh.emplace_back();
      for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
        const std::string where = document_.at("meshes", i) + "/primitives/" + std::to_string(k);
        if (mesh.primitives[k].mode < TINYGLTF_MODE_TRIANGLES) {
          result_.findings.push_back(asset_finding(Severity::warning, "asset.no-area", where,
                                                   "points and lines have no area and are left out"));
          continue;
        }
        Result<ModelPart> part = read_primitive(mesh.primitives[k], where);
        if (!part) return part.fault();
        parts.push_back(*std::move(part));
      }
    }
    return std::move(result_);
  }

 private:
  Result<ModelPart> read_primitive(const tinygltf::Primitive& primitive, const std::string& where) {
    const Sources sources = find_sources(primitive, where);
    std::shared_ptr<const Mesh>& known = meshes_[sources];
    if (!known) {
      Result<Mesh> mesh = read_mesh(sources, where);
      if (!mesh) return mesh.fault();
      known = std::make_shared<const Mesh>(*std::move(mesh));
    }
    return ModelPart{known, primitive.material};
  }

  Sources find_sources(const tinygltf::Primitive& primitive, const std::string& where) {
    const auto attribute = [&](const std::string& name) {
      const auto found = primitive.attributes.find(name);
      return found == primitive.attributes.end() ? -1 : found->second;
    };
    const int uv_set = primitive.material < 0 ? -1 : materials_.uv_set[static_cast<std::size_t>(primitive.material)];
    Sources sources;
    sources.mode = primitive.mode;
    sources.indices = primitive.indices;
    sources.position = attribute("POSITION");
    sources.normal = attribute("NORMAL");
    sources.uv = attribute("TEXCOORD_" + std::to_string(uv_set < 0 ? 0 : uv_set));
    if (attribute("COLOR_0") >= 0) {
      result_.findings.push_back(asset_finding(Severity::info, "asset.colors", where, "vertex colours are left out"));
    }
    return sources;
  }

  std::vector<std::uint32_t> read_corners(const Sources& sources, std::size_t vertices) const {
    if (sources.indices >= 0) return read_integers(document_, sources.indices);
    std::vector<std::uint32_t> corners(vertices);
    std::iota(corners.begin(), corners.end(), 0u);
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
    for (const glm::dvec4& p : read_vectors(document_, sources.position)) mesh.positions_m.emplace_back(p);
    if (sources.normal >= 0) {
      for (const glm::dvec4& n : read_vectors(document_, sources.normal)) mesh.normals.emplace_back(n);
      if (!make_normals_unit(mesh)) {
        result_.findings.push_back(
            asset_finding(Severity::warning, "asset.normals", where, "a normal has no length; faces are lit flat"));
      }
    }
    if (sources.uv >= 0) {
      // glTF counts from the upper edge.
      for (const glm::dvec4& uv : read_vectors(document_, sources.uv)) mesh.uvs.emplace_back(uv.x, 1.0 - uv.y);
    }
    mesh.triangles = triangles_from(read_corners(sources, vertices), sources.mode);
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
