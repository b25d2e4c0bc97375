#include "core/process/vertices.h"

#include <map>
#include <utility>

#include <glm/geometric.hpp>

#include "core/mesh/edges.h"
#include "core/mesh/joined_sets.h"
#include "core/mesh/measure.h"

namespace focalstage {

Mesh mesh_of_vertices(const Mesh& mesh, std::span<const std::uint32_t> vertices, std::vector<glm::uvec3> triangles) {
  Mesh picked;
  picked.triangles = std::move(triangles);
  for (const std::uint32_t vertex : vertices) {
    picked.positions_m.push_back(mesh.positions_m[vertex]);
    if (!mesh.normals.empty()) picked.normals.push_back(mesh.normals[vertex]);
    if (!mesh.uvs.empty()) picked.uvs.push_back(mesh.uvs[vertex]);
    if (!mesh.colors.empty()) picked.colors.push_back(mesh.colors[vertex]);
  }
  return picked;
}

Mesh mesh_of_triangles(const Mesh& mesh, const std::vector<bool>& kept) {
  std::vector<bool> used(mesh.positions_m.size());
  std::vector<glm::uvec3> triangles;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!kept[i]) continue;
    triangles.push_back(mesh.triangles[i]);
    for (int k = 0; k < 3; ++k) used[mesh.triangles[i][k]] = true;
  }
  std::vector<std::uint32_t> new_place(mesh.positions_m.size());
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    new_place[i] = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(i);
  }
  for (glm::uvec3& triangle : triangles) {
    for (int k = 0; k < 3; ++k) triangle[k] = new_place[triangle[k]];
  }
  return mesh_of_vertices(mesh, vertices, std::move(triangles));
}

namespace {

constexpr double cos_crease = 0.70710678118654752440;  // 45 degrees

/// Corner k of triangle i is 3 i + k. Corners in one place are joined across edges that are no crease.
JoinedSets joined_corners(const Mesh& mesh, const std::vector<glm::dvec3>& areas) {
  JoinedSets corners(mesh.triangles.size() * 3);
  Edges(mesh).each([&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2 || uses[0].forward == uses[1].forward) return;
    const glm::dvec3& one = areas[uses[0].triangle];
    const glm::dvec3& other = areas[uses[1].triangle];
    if (!(glm::dot(one, other) > cos_crease * glm::length(one) * glm::length(other))) return;
    const std::uint32_t begin[2] = {3 * uses[0].triangle + uses[0].side, 3 * uses[1].triangle + uses[1].side};
    const std::uint32_t end[2] = {3 * uses[0].triangle + (uses[0].side + 1U) % 3,
                                  3 * uses[1].triangle + (uses[1].side + 1U) % 3};
    corners.join(begin[0], end[1]);  // the two run along it opposite ways
    corners.join(end[0], begin[1]);
  });
  return corners;
}

}  // namespace

Mesh with_normals(const Mesh& mesh) {
  std::vector<glm::dvec3> areas;
  for (const glm::uvec3& triangle : mesh.triangles) areas.push_back(doubled_area(mesh, triangle));
  JoinedSets corners = joined_corners(mesh, areas);
  std::vector<glm::dvec3> sums(3 * areas.size(), glm::dvec3(0.0));
  for (std::uint32_t i = 0; i < sums.size(); ++i) sums[corners.root(i)] += areas[i / 3];
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> place_of;  // of a vertex and its corners' set
  std::vector<std::uint32_t> vertices;
  std::vector<glm::dvec3> normals;
  std::vector<glm::uvec3> triangles = mesh.triangles;
  for (std::uint32_t i = 0; i < sums.size(); ++i) {
    std::uint32_t& vertex = triangles[i / 3][static_cast<int>(i % 3)];
    const std::uint32_t set = corners.root(i);
    const auto [entry, is_new] = place_of.try_emplace({vertex, set}, static_cast<std::uint32_t>(vertices.size()));
    if (is_new) {
      vertices.push_back(vertex);
      const double length = glm::length(sums[set]);
      normals.push_back(length > 0.0 ? sums[set] / length : glm::dvec3(0.0, 1.0, 0.0));
    }
    vertex = entry->second;
  }
  Mesh made = mesh_of_vertices(mesh, vertices, std::move(triangles));
  made.normals = std::move(normals);
  return made;
}

}  // namespace focalstage
