#include "io/assets/gltf_meshes.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include <glm/common.hpp>

#include "io/assets/gltf_deformations.h"

namespace focalstage {
namespace {

/// The accessors a mesh is made of; -1 for none.
struct Sources {
  int mode = 0;
  int indices = -1;
  int position = -1;
  int normal = -1;
  int uv = -1;
  int color = -1;
  std::array<double, 5> uv_transform{};  ///< KHR_texture_transform's, which moves the UVs themselves

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
      : document_(document), materials_(materials), deformations_(document) {}

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
        if (is_cut_away(mesh.primitives[k].material)) continue;
        note_vertex_alpha(mesh.primitives[k], where);
        Result<ModelPart> part = read_primitive(mesh.primitives[k], where);
        if (!part) return part.fault();
        parts.push_back(*std::move(part));
      }
    }
    const std::vector<Finding>& more = deformations_.findings();
    result_.findings.insert(result_.findings.end(), more.begin(), more.end());
    return std::move(result_);
  }

 private:
  TextureLayout layout_of(int material) const {
    return material < 0 ? TextureLayout{} : materials_.layouts[static_cast<std::size_t>(material)];
  }

  bool is_cut_away(int material) const {
    return material >= 0 && materials_.invisible[static_cast<std::size_t>(material)];
  }

  /// A material that uses alpha has the vertices', too.
  void note_vertex_alpha(const tinygltf::Primitive& primitive, const std::string& where) {
    const auto color = primitive.attributes.find("COLOR_0");
    if (primitive.material < 0 || color == primitive.attributes.end()) return;
    const bool opaque = document_.gltf.materials[static_cast<std::size_t>(primitive.material)].alphaMode == "OPAQUE";
    if (opaque || accessor_at(document_, color->second)->type != TINYGLTF_TYPE_VEC4) return;
    result_.findings.push_back(asset_finding(Severity::info, "asset.drawn-opaque", where + "/attributes/COLOR_0",
                                             "the alpha of vertex colours is left out"));
  }

  Result<ModelPart> read_primitive(const tinygltf::Primitive& primitive, const std::string& where) {
    const Sources sources = find_sources(primitive);
    std::shared_ptr<const Mesh>& known = meshes_[sources];
    if (!known) {
      Result<Mesh> mesh = read_mesh(sources, layout_of(primitive.material), where);
      if (!mesh) return mesh.fault();
      known = std::make_shared<const Mesh>(*std::move(mesh));
    }
    Result<std::shared_ptr<const Deformation>> deformation = deformations_.of(primitive, where);
    if (!deformation) return deformation.fault();
    return ModelPart{known, primitive.material, *std::move(deformation)};
  }

  Sources find_sources(const tinygltf::Primitive& primitive) const {
    const auto attribute = [&](const std::string& name) {
      const auto found = primitive.attributes.find(name);
      return found == primitive.attributes.end() ? -1 : found->second;
    };
    const TextureLayout layout = layout_of(primitive.material);
    Sources sources;
    sources.mode = primitive.mode;
    sources.indices = primitive.indices;
    sources.position = attribute("POSITION");
    sources.normal = attribute("NORMAL");
    sources.uv = attribute("TEXCOORD_" + std::to_string(std::max(layout.uv_set, 0)));
    sources.color = attribute("COLOR_0");
    sources.uv_transform = {layout.offset.x, layout.offset.y, layout.rotation, layout.scale.x, layout.scale.y};
    return sources;
  }

  std::vector<std::uint32_t> read_corners(const Sources& sources, std::size_t vertices) const {
    if (sources.indices >= 0) return read_integers(document_, sources.indices);
    std::vector<std::uint32_t> corners(vertices);
    std::iota(corners.begin(), corners.end(), 0u);
    return corners;
  }

  Result<Mesh> read_mesh(const Sources& sources, const TextureLayout& layout, const std::string& where) {
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
      for (const glm::dvec4& uv : read_vectors(document_, sources.uv)) mesh.uvs.push_back(layout.uv_from(uv));
    }
    if (sources.color >= 0) {
      for (const glm::dvec4& color : read_vectors(document_, sources.color)) {
        mesh.colors.push_back(glm::clamp(glm::dvec3(color), 0.0, 1.0));  // as the specification demands
      }
    }
    mesh.triangles = triangles_from(read_corners(sources, vertices), sources.mode);
    result_.triangles += mesh.triangles.size();
    return mesh;
  }

  const GltfDocument& document_;
  const GltfMaterials& materials_;
  GltfDeformations deformations_;
  GltfMeshes result_;
  std::map<Sources, std::shared_ptr<const Mesh>> meshes_;
};

}  // namespace

Result<GltfMeshes> read_gltf_meshes(const GltfDocument& document, const GltfMaterials& materials) {
  return MeshReader(document, materials).read();
}

}  // namespace focalstage
