#include "io/assets/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include <glm/geometric.hpp>

namespace focalstage {
namespace {

std::string lower_case_ending(const std::string& path) {
  const std::size_t dot = path.find_last_of("./");
  if (dot == std::string::npos || path[dot] != '.') return {};
  std::string ending = path.substr(dot + 1);
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending;
}

using Reader = Result<MeshFile> (*)(const FileToRead&);

constexpr std::pair<const char*, Reader> readers[] = {
    {"obj", read_obj}, {"ply", read_ply}, {"stl", read_stl}, {"off", read_off}, {"gltf", read_gltf}, {"glb", read_gltf},
};

}  // namespace

Fault invalid_asset(const std::string& where, const std::string& what) {
  return {"asset.invalid", where, what, "export the file again"};
}

Fault unsupported_asset(const std::string& where, const std::string& what, const std::string& remedy) {
  return {"asset.unsupported", where, what, remedy};
}

Finding asset_finding(Severity severity, const std::string& code, const std::string& where, const std::string& what) {
  return {severity, code, where, what, std::nullopt, {}};
}

Result<MeshFile> read_mesh_file(const FileToRead& file) {
  const std::string ending = lower_case_ending(file.path);
  for (const auto& [name, reader] : readers) {
    if (ending != name) continue;
    try {
      return reader(file);
    } catch (const std::bad_alloc&) {
      return Fault{"asset.too-large", file.path, "there is no memory for what the file holds", "use a smaller mesh"};
    }
  }
  return unsupported_asset(file.path, "the format of this file is not known by its ending",
                           "use obj, ply, stl, off, gltf or glb");
}

Result<MeshFile> file_of_meshes(const std::string& path, std::vector<Mesh> meshes, std::vector<int> material_of_mesh,
                                std::size_t vertices) {
  MeshFile file;
  file.vertices = vertices;
  file.model.nodes.emplace_back();
  std::size_t corners = 0;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    file.triangles += meshes[i].triangles.size();
    corners += meshes[i].positions_m.size();
    file.model.nodes[0].parts.push_back({std::make_shared<const Mesh>(std::move(meshes[i])), material_of_mesh[i]});
  }
  if (file.triangles == 0) return invalid_asset(path, "the file holds no triangle");
  if (file.triangles > most_vertices || corners > most_vertices) {
    return Fault{"asset.too-large", path, "the file holds more than 2^24 vertices or triangles", "simplify the mesh"};
  }
  return file;
}

bool make_normals_unit(Mesh& mesh) {
  for (glm::dvec3& normal : mesh.normals) {
    const double largest = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
    if (!(largest > 0.0)) {
      mesh.normals.clear();
      return false;
    }
    normal = glm::normalize(normal / largest);
  }
  return true;
}

}  // namespace focalstage
