#include "core/mesh/smooth_parts.h"

#include <algorithm>
#include <numeric>

#include <glm/geometric.hpp>

#include "core/mesh/measure.h"

namespace focalstage {
namespace {

constexpr double cos_30_deg = 0.86602540378443864676;
constexpr std::size_t most_around_an_edge = 8;  ///< more triangles than this on one edge are taken for a fold

/// One triangle's side, keyed by its two welded corners, the smaller first.
struct Side {
  std::uint64_t edge;
  std::uint32_t triangle;
  bool forward;  ///< whether the triangle runs from the smaller corner to the larger

  bool operator<(const Side& other) const { return edge != other.edge ? edge < other.edge : triangle < other.triangle; }
};

std::vector<Side> sorted_sides(const Mesh& mesh) {
  const std::vector<std::uint32_t> welded = welded_indices(mesh);
  std::vector<Side> sides;
  sides.reserve(mesh.triangles.size() * 3);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = welded[mesh.triangles[i][k]];
      const std::uint32_t b = welded[mesh.triangles[i][(k + 1) % 3]];
      if (a == b) continue;
      sides.push_back({std::uint64_t{std::min(a, b)} << 32 | std::max(a, b), static_cast<std::uint32_t>(i), a < b});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// Unit normals; zero for a triangle without area.
std::vector<glm::dvec3> face_normals(const Mesh& mesh) {
  std::vector<glm::dvec3> normals;
  normals.reserve(mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 area = doubled_area(mesh.positions_m[t.x], mesh.positions_m[t.y], mesh.positions_m[t.z]);
    const double length = glm::length(area);
    normals.push_back(length > 0.0 ? area / length : glm::dvec3(0.0));
  }
  return normals;
}

/// Sets that merge; the smallest member stands for its set.
class Groups {
 public:
  explicit Groups(std::size_t count) : up_(count) { std::iota(up_.begin(), up_.end(), 0u); }

  std::uint32_t root(std::uint32_t i) {
    while (up_[i] != i) i = up_[i] = up_[up_[i]];
    return i;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    up_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> up_;
};

void join_smooth_neighbours(Groups& groups, const std::vector<Side>& sides, const std::vector<glm::dvec3>& normals) {
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin + 1;
    while (end < sides.size() && sides[end].edge == sides[begin].edge) ++end;
    for (std::size_t i = begin; end - begin <= most_around_an_edge && i < end; ++i) {
      for (std::size_t j = i + 1; j < end; ++j) {
        // Neighbours that wind alike run along their edge in opposite directions.
        const double turn = sides[i].forward == sides[j].forward ? -1.0 : 1.0;
        if (turn * glm::dot(normals[sides[i].triangle], normals[sides[j].triangle]) > cos_30_deg) {
          groups.join(sides[i].triangle, sides[j].triangle);
        }
      }
    }
    begin = end;
  }
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

SmoothParts smooth_parts(const Mesh& mesh) {
  Groups groups(mesh.triangles.size());
  join_smooth_neighbours(groups, sorted_sides(mesh), face_normals(mesh));
  SmoothParts parts;
  parts.part_of_triangle.resize(mesh.triangles.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < parts.part_of_triangle.size(); ++i) {
    const std::uint32_t root = groups.root(i);
    parts.part_of_triangle[i] = root == i ? count++ : parts.part_of_triangle[root];
  }
  parts.area_m2.resize(count);
  parts.centre_m.resize(count);
  measure(parts, mesh, glm::dmat4(1.0));
  return parts;
}

SmoothParts placed(const SmoothParts& parts, const Mesh& mesh, const glm::dmat4& world_from_mesh) {
  SmoothParts result = parts;
  measure(result, mesh, world_from_mesh);
  return result;
}

}  // namespace focalstage
