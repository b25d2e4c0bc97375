#include "core/mesh/smooth_parts.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

#include "core/mesh/edges.h"
#include "core/mesh/joined_sets.h"
#include "core/mesh/measure.h"

namespace focalstage {
namespace {

constexpr std::size_t most_around_an_edge = 8;  ///< more triangles than this on one edge are taken for a fold

/// Unit normals; zero for a triangle without area.
std::vector<glm::dvec3> face_normals(const Mesh& mesh) {
  std::vector<glm::dvec3> normals;
  normals.reserve(mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 area = doubled_area(mesh, t);
    const double length = glm::length(area);
    normals.push_back(length > 0.0 ? area / length : glm::dvec3(0.0));
  }
  return normals;
}

void join_smooth_neighbours(JoinedSets& sets, const Edges& edges, const std::vector<glm::dvec3>& normals,
                            double cos_fold) {
  edges.each([&](std::span<const EdgeUse> uses) {
    if (uses.size() > most_around_an_edge) return;
    for (std::size_t i = 0; i < uses.size(); ++i) {
      for (std::size_t j = i + 1; j < uses.size(); ++j) {
        // Neighbours that wind alike run along their edge in opposite directions.
        const double turn = uses[i].forward == uses[j].forward ? -1.0 : 1.0;
        if (turn * glm::dot(normals[uses[i].triangle], normals[uses[j].triangle]) > cos_fold) {
          sets.join(uses[i].triangle, uses[j].triangle);
        }
      }
    }
  });
}

void measure(SmoothParts& parts, const Mesh& mesh, const glm::dmat4& world_from_mesh) {
  const std::size_t count = parts.area_m2.size();
  std::vector<glm::dvec3> moment(count, glm::dvec3(0.0));
  std::vector<glm::dvec3> corner_sum(count, glm::dvec3(0.0));
  std::vector<double> triangles(count, 0.0);
  std::fill(parts.area_m2.begin(), parts.area_m2.end(), 0.0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    glm::dvec3 corner[3];
    for (int k = 0; k < 3; ++k) {
      corner[k] = glm::dvec3(world_from_mesh * glm::dvec4(mesh.positions_m[mesh.triangles[i][k]], 1.0));
    }
    const std::uint32_t part = parts.part_of_triangle[i];
    const double area_m2 = 0.5 * glm::length(doubled_area(corner[0], corner[1], corner[2]));
    const glm::dvec3 middle = (corner[0] + corner[1] + corner[2]) / 3.0;
    parts.area_m2[part] += area_m2;
    moment[part] += area_m2 * middle;
    corner_sum[part] += middle;
    triangles[part] += 1.0;
  }
  for (std::size_t part = 0; part < count; ++part) {
    const double area_m2 = parts.area_m2[part];
    parts.centre_m[part] = area_m2 > 0.0 ? moment[part] / area_m2 : corner_sum[part] / triangles[part];
  }
}

}  // namespace

SmoothParts smooth_parts(const Mesh& mesh, double cos_fold) {
  JoinedSets sets(mesh.triangles.size());
  join_smooth_neighbours(sets, Edges(mesh), face_normals(mesh), cos_fold);
  TriangleGroups groups = numbered(sets, mesh.triangles.size());
  SmoothParts parts;
  parts.part_of_triangle = std::move(groups.of_triangle);
  parts.area_m2.resize(groups.count);
  parts.centre_m.resize(groups.count);
  measure(parts, mesh, glm::dmat4(1.0));
  return parts;
}

SmoothParts placed(const SmoothParts& parts, const Mesh& mesh, const glm::dmat4& world_from_mesh) {
  SmoothParts result = parts;
  measure(result, mesh, world_from_mesh);
  return result;
}

}  // namespace focalstage
