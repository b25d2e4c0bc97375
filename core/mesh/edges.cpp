#include "core/mesh/edges.h"

#include <algorithm>
#include <tuple>

#include "core/mesh/joined_sets.h"
#include "core/mesh/measure.h"

namespace focalstage {

Edges::Edges(const Mesh& mesh) : place_of_(welded_indices(mesh)) {
  uses_.reserve(mesh.triangles.size() * 3);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    glm::uvec3 corner;
    for (int k = 0; k < 3; ++k) corner[k] = place_of_[mesh.triangles[i][k]];
    if (corner.x == corner.y || corner.y == corner.z || corner.z == corner.x) continue;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t from = corner[k];
      const std::uint32_t to = corner[(k + 1) % 3];
      uses_.push_back({std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(i),
                       static_cast<std::uint8_t>(k), from < to});
    }
  }
  std::ranges::sort(uses_, [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
}

TriangleGroups numbered(JoinedSets& sets, std::size_t triangles) {
  TriangleGroups groups;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const std::uint32_t root = sets.root(i);
    groups.of_triangle.push_back(root == i ? static_cast<std::uint32_t>(groups.count++) : groups.of_triangle[root]);
  }
  return groups;
}

TriangleGroups connected_triangles(const Mesh& mesh, const Edges& edges, bool across_forks) {
  JoinedSets sets(mesh.triangles.size());
  edges.each([&](std::span<const EdgeUse> uses) {
    if (!across_forks && uses.size() > 2) return;
    for (const EdgeUse& use : uses.subspan(1)) sets.join(uses.front().triangle, use.triangle);
  });
  return numbered(sets, mesh.triangles.size());
}

std::vector<double> group_areas_m2(const Mesh& mesh, const TriangleGroups& groups) {
  std::vector<double> areas_m2(groups.count, 0.0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    areas_m2[groups.of_triangle[i]] += triangle_area_m2(mesh, mesh.triangles[i]);
  }
  return areas_m2;
}

}  // namespace focalstage
