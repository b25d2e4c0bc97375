#include "core/mesh/measure.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

#include <glm/geometric.hpp>

#include "core/mesh/position_hash.h"

namespace focalstage {
namespace {

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Fault invalid(const std::string& what) { return {"mesh.invalid", "", what, "repair the mesh"}; }

}  // namespace

Bounds mesh_bounds(const Mesh& mesh) {
  Bounds bounds;
  for (const glm::uvec3& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) bounds.include(mesh.positions_m[triangle[i]]);
  }
  return bounds;
}

glm::dvec3 doubled_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return glm::cross(b - a, c - a);
}

glm::dvec3 doubled_area(const Mesh& mesh, const glm::uvec3& triangle) {
  return doubled_area(mesh.positions_m[triangle.x], mesh.positions_m[triangle.y], mesh.positions_m[triangle.z]);
}

double triangle_area_m2(const Mesh& mesh, const glm::uvec3& triangle) {
  return 0.5 * glm::length(doubled_area(mesh, triangle));
}

double mesh_area_m2(const Mesh& mesh) {
  double area_m2 = 0.0;
  for (const glm::uvec3& triangle : mesh.triangles) area_m2 += triangle_area_m2(mesh, triangle);
  return area_m2;
}

double enclosed_volume_m3(const Mesh& mesh) {
  double volume_m3 = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    volume_m3 += glm::dot(mesh.positions_m[t.x], glm::cross(mesh.positions_m[t.y], mesh.positions_m[t.z])) / 6.0;
  }
  return volume_m3;
}

bool is_closed(const Mesh& mesh) {
  const std::vector<std::uint32_t> welded = welded_indices(mesh);
  std::vector<std::uint64_t> directed;
  directed.reserve(mesh.triangles.size() * 3);
  for (const glm::uvec3& t : mesh.triangles) {
    const std::uint32_t corner[3] = {welded[t.x], welded[t.y], welded[t.z]};
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;  // bounds nothing
    for (int i = 0; i < 3; ++i) directed.push_back(std::uint64_t{corner[i]} << 32 | corner[(i + 1) % 3]);
  }
  std::sort(directed.begin(), directed.end());
  if (directed.empty() || std::adjacent_find(directed.begin(), directed.end()) != directed.end()) return false;
  return std::all_of(directed.begin(), directed.end(), [&](std::uint64_t edge) {
    return std::binary_search(directed.begin(), directed.end(), edge << 32 | edge >> 32);
  });
}

Status check_mesh(const Mesh& mesh) {
  const std::size_t count = mesh.positions_m.size();
  if (!mesh.normals.empty() && mesh.normals.size() != count) return invalid("not one normal per vertex");
  if (!mesh.uvs.empty() && mesh.uvs.size() != count) return invalid("not one texture coordinate per vertex");
  if (!mesh.colors.empty() && mesh.colors.size() != count) return invalid("not one colour per vertex");
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    if (std::max({t.x, t.y, t.z}) >= count) {
      return invalid("triangle " + std::to_string(i) + " names a vertex beyond the " + std::to_string(count) +
                     " there are");
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const bool good = finite(mesh.positions_m[i]) && (mesh.normals.empty() || finite(mesh.normals[i])) &&
                      (mesh.colors.empty() || finite(mesh.colors[i])) &&
                      (mesh.uvs.empty() || (std::isfinite(mesh.uvs[i].x) && std::isfinite(mesh.uvs[i].y)));
    if (!good) return invalid("vertex " + std::to_string(i) + " is not finite");
  }
  return {};
}

std::vector<std::uint32_t> welded_indices(const Mesh& mesh) {
  std::unordered_map<glm::dvec3, std::uint32_t, PositionHash> first_at;
  first_at.reserve(mesh.positions_m.size());
  std::vector<std::uint32_t> welded;
  welded.reserve(mesh.positions_m.size());
  for (std::size_t i = 0; i < mesh.positions_m.size(); ++i) {
    welded.push_back(first_at.try_emplace(mesh.positions_m[i], static_cast<std::uint32_t>(i)).first->second);
  }
  return welded;
}

}  // namespace focalstage
