#include "core/process/winding.h"

#include <array>
#include <deque>
#include <map>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

#include "core/mesh/measure.h"
#include "core/process/vertices.h"

namespace focalstage {

namespace {

struct Neighbour {
  std::uint32_t triangle = 0;
  bool against = false;  ///< runs along the common edge the same way
};

/// Across each of a triangle's three sides, where exactly one other triangle is.
using Neighbours = std::vector<std::array<std::optional<Neighbour>, 3>>;

Neighbours neighbours_of(const Mesh& mesh, const Edges& edges) {
  Neighbours neighbours(mesh.triangles.size());
  edges.each([&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2) return;
    const bool against = uses[0].forward == uses[1].forward;
    neighbours[uses[0].triangle][uses[0].side] = Neighbour{uses[1].triangle, against};
    neighbours[uses[1].triangle][uses[1].side] = Neighbour{uses[0].triangle, against};
  });
  return neighbours;
}

/// Which triangles have to turn so that all wind as the first of their group does.
std::vector<bool> against_first(const Neighbours& neighbours) {
  std::vector<bool> turned(neighbours.size());
  std::vector<bool> met(neighbours.size());
  for (std::uint32_t first = 0; first < neighbours.size(); ++first) {
    if (met[first]) continue;
    met[first] = true;
    std::deque<std::uint32_t> edge{first};
    while (!edge.empty()) {
      const std::uint32_t triangle = edge.front();
      edge.pop_front();
      for (const auto& neighbour : neighbours[triangle]) {
        if (!neighbour || met[neighbour->triangle]) continue;
        met[neighbour->triangle] = true;
        turned[neighbour->triangle] = turned[triangle] != neighbour->against;
        edge.push_back(neighbour->triangle);
      }
    }
  }
  return turned;
}

/// Turns those triangles. A vertex that also belongs to others comes twice, with its normal either way.
Mesh with_turned(const Mesh& mesh, const std::vector<bool>& turned) {
  std::map<std::pair<std::uint32_t, bool>, std::uint32_t> new_place;
  std::vector<std::uint32_t> vertices;
  std::vector<bool> vertex_turned;
  std::vector<glm::uvec3> triangles = mesh.triangles;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const bool turn = turned[i] && !mesh.normals.empty();
    for (int k = 0; k < 3; ++k) {
      const auto [entry, is_new] =
          new_place.try_emplace({triangles[i][k], turn}, static_cast<std::uint32_t>(vertices.size()));
      if (is_new) {
        vertices.push_back(triangles[i][k]);
        vertex_turned.push_back(turn);
      }
      triangles[i][k] = entry->second;
    }
    if (turned[i]) std::swap(triangles[i].y, triangles[i].z);
  }
  Mesh made = mesh_of_vertices(mesh, vertices, std::move(triangles));
  for (std::size_t i = 0; i < made.normals.size(); ++i) {
    if (vertex_turned[i]) made.normals[i] = -made.normals[i];
  }
  return made;
}

}  // namespace

Mesh flipped(const Mesh& mesh) {
  Mesh made = mesh;
  for (glm::uvec3& triangle : made.triangles) std::swap(triangle.y, triangle.z);
  for (glm::dvec3& normal : made.normals) normal = -normal;
  return made;
}

std::size_t edges_against(const Edges& edges) {
  std::size_t count = 0;
  edges.each([&](std::span<const EdgeUse> uses) {
    if (uses.size() == 2 && uses[0].forward == uses[1].forward) ++count;
  });
  return count;
}

std::vector<bool> closed_groups(const Edges& edges, const TriangleGroups& groups) {
  std::vector<bool> closed(groups.count, true);
  edges.each([&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2) closed[groups.of_triangle[uses.front().triangle]] = false;
  });
  return closed;
}

std::vector<double> group_volumes_m3(const Mesh& mesh, const TriangleGroups& groups) {
  std::vector<double> volumes_m3(groups.count, 0.0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    volumes_m3[groups.of_triangle[i]] +=
        glm::dot(mesh.positions_m[t.x], glm::cross(mesh.positions_m[t.y], mesh.positions_m[t.z])) / 6.0;
  }
  return volumes_m3;
}

Mesh evenly_wound(const Mesh& mesh) {
  const Edges edges(mesh);
  const TriangleGroups groups = connected_triangles(mesh, edges, false);
  std::vector<bool> turned = against_first(neighbours_of(mesh, edges));
  const std::vector<bool> closed = closed_groups(edges, groups);
  std::vector<double> turned_less_kept_m2(groups.count, 0.0);
  Mesh even = mesh;
  for (std::size_t i = 0; i < turned.size(); ++i) {
    turned_less_kept_m2[groups.of_triangle[i]] += (turned[i] ? 1.0 : -1.0) * triangle_area_m2(mesh, mesh.triangles[i]);
    if (turned[i]) std::swap(even.triangles[i].y, even.triangles[i].z);
  }
  const std::vector<double> volumes_m3 = group_volumes_m3(even, groups);
  for (std::size_t i = 0; i < turned.size(); ++i) {
    const std::uint32_t group = groups.of_triangle[i];
    if (closed[group] ? volumes_m3[group] < 0.0 : turned_less_kept_m2[group] > 0.0) turned[i] = !turned[i];
  }
  return with_turned(mesh, turned);
}

}  // namespace focalstage
