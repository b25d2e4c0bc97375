#include "core/process/clean.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "core/mesh/measure.h"
#include "core/mesh/position_hash.h"
#include "core/process/vertices.h"

namespace focalstage {

namespace {

/// Points that have been met, in cells as large as the tolerance.
class NearPoints {
 public:
  NearPoints(const Mesh& mesh, double tolerance_m) : mesh_(mesh), tolerance_m_(tolerance_m) {}

  /// The first point met that is near; else this one, from now on among them.
  std::uint32_t find_or_add(std::uint32_t vertex) {
    const glm::dvec3& position_m = mesh_.positions_m[vertex];
    const glm::i64vec3 cell(glm::floor(position_m / tolerance_m_));
    std::uint32_t first = vertex;
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        for (std::int64_t dz = -1; dz <= 1; ++dz) {
          const auto met = cells_.find(cell + glm::i64vec3(dx, dy, dz));
          if (met == cells_.end()) continue;
          for (const std::uint32_t other : met->second) {
            if (other < first && glm::distance(mesh_.positions_m[other], position_m) <= tolerance_m_) first = other;
          }
        }
      }
    }
    if (first == vertex) cells_[cell].push_back(vertex);
    return first;
  }

 private:
  const Mesh& mesh_;
  double tolerance_m_;
  std::unordered_map<glm::i64vec3, std::vector<std::uint32_t>, PositionHash> cells_;
};

void move_together(Mesh& mesh, double tolerance_m) {
  NearPoints points(mesh, tolerance_m);
  std::vector<std::uint32_t> first(mesh.positions_m.size());
  for (std::uint32_t i = 0; i < first.size(); ++i) first[i] = points.find_or_add(i);
  for (std::size_t i = 0; i < first.size(); ++i) mesh.positions_m[i] = mesh.positions_m[first[i]];
}

/// What a vertex carries, to be compared.
std::array<double, 11> carried(const Mesh& mesh, std::size_t vertex) {
  std::array<double, 11> all{};
  for (int k = 0; k < 3; ++k) {
    all[static_cast<std::size_t>(k)] = mesh.positions_m[vertex][k] + 0.0;  // -0 is 0
    if (!mesh.normals.empty()) all[static_cast<std::size_t>(3 + k)] = mesh.normals[vertex][k] + 0.0;
    if (!mesh.colors.empty()) all[static_cast<std::size_t>(8 + k)] = mesh.colors[vertex][k] + 0.0;
    if (k < 2 && !mesh.uvs.empty()) all[static_cast<std::size_t>(6 + k)] = mesh.uvs[vertex][k] + 0.0;
  }
  return all;
}

}  // namespace

Mesh welded(const Mesh& mesh, double tolerance_m) {
  Mesh moved = mesh;
  if (tolerance_m > 0.0) move_together(moved, tolerance_m);
  std::map<std::array<double, 11>, std::uint32_t> first_with;
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> new_place;
  for (std::uint32_t i = 0; i < moved.positions_m.size(); ++i) {
    const auto [entry, is_new] = first_with.try_emplace(carried(moved, i), static_cast<std::uint32_t>(vertices.size()));
    if (is_new) vertices.push_back(i);
    new_place.push_back(entry->second);
  }
  std::vector<glm::uvec3> triangles;
  for (const glm::uvec3& t : mesh.triangles) {
    const auto& at = moved.positions_m;
    const bool lost = at[t.x] == at[t.y] || at[t.y] == at[t.z] || at[t.z] == at[t.x];
    if (!lost) triangles.emplace_back(new_place[t.x], new_place[t.y], new_place[t.z]);
  }
  return mesh_of_vertices(moved, vertices, std::move(triangles));
}

Unclean unclean_triangles(const Mesh& mesh) {
  const std::vector<std::uint32_t> place = welded_indices(mesh);
  std::vector<std::array<std::uint32_t, 4>> corners;  // sorted, and the triangle
  Unclean found{std::vector<bool>(mesh.triangles.size()), std::vector<bool>(mesh.triangles.size())};
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    if (!(triangle_area_m2(mesh, t) > 0.0)) {
      found.no_area[i] = true;
      continue;
    }
    std::array<std::uint32_t, 3> sorted{place[t.x], place[t.y], place[t.z]};
    std::ranges::sort(sorted);
    corners.push_back({sorted[0], sorted[1], sorted[2], i});
  }
  std::ranges::sort(corners);
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (std::equal(corners[i].begin(), corners[i].begin() + 3, corners[i - 1].begin())) {
      found.repeated[corners[i][3]] = true;
    }
  }
  return found;
}

Mesh cleaned(const Mesh& mesh) {
  const Unclean unclean = unclean_triangles(mesh);
  std::vector<bool> kept(mesh.triangles.size());
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = !unclean.no_area[i] && !unclean.repeated[i];
  return mesh_of_triangles(mesh, kept);
}

}  // namespace focalstage
