#include "core/calibrate/model_edges.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include <glm/geometric.hpp>

namespace focalstage {

namespace {

const double fold_cosine = std::cos(0.3490658503988659);  // 20 degrees

using Corner = std::array<double, 3>;

/// The faces at one edge: their normals, and whether they are turned towards the looker.
struct Meeting {
  int faces = 0;
  glm::dvec3 normal{0.0};
  bool towards = false;
  bool drawn = false;
};

/// By both ends, the lesser first.
using Meetings = std::map<std::pair<Corner, Corner>, Meeting>;

void meet(Meeting& edge, const glm::dvec3& normal, bool towards) {
  if (edge.faces > 0) {
    // Neighbours may be wound differently: the fold is what their planes do.
    const bool folded = std::abs(glm::dot(edge.normal, normal)) < fold_cosine;
    edge.drawn = edge.drawn || folded || edge.towards != towards || edge.faces > 1;
  }
  edge.normal = normal;
  edge.towards = towards;
  ++edge.faces;
}

void add_faces(const Drawable& drawable, const glm::dvec3& from_m, Meetings& edges) {
  const Mesh& mesh = *drawable.mesh;
  for (const glm::uvec3& triangle : mesh.triangles) {
    std::array<glm::dvec3, 3> at;
    for (int i = 0; i < 3; ++i) {
      at[static_cast<std::size_t>(i)] =
          glm::dvec3(drawable.world_from_mesh * glm::dvec4(mesh.positions_m[triangle[i]], 1.0));
    }
    const glm::dvec3 across = glm::cross(at[1] - at[0], at[2] - at[0]);
    if (!(glm::length(across) > 0.0)) continue;
    const glm::dvec3 normal = glm::normalize(across);
    const bool towards = glm::dot(normal, from_m - at[0]) > 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3& a = at[i];
      const glm::dvec3& b = at[(i + 1) % 3];
      const Corner first{a.x, a.y, a.z};
      const Corner second{b.x, b.y, b.z};
      meet(edges[first < second ? std::pair(first, second) : std::pair(second, first)], normal, towards);
    }
  }
}

}  // namespace

std::vector<WorldEdge> model_edges(const std::vector<StagedSurface>& surfaces, const glm::dvec3& from_m) {
  std::vector<WorldEdge> drawn;
  for (const StagedSurface& surface : surfaces) {
    Meetings edges;
    for (const Drawable& drawable : surface.drawables) add_faces(drawable, from_m, edges);
    for (const auto& [ends, edge] : edges) {
      if (!edge.drawn && edge.faces > 1) continue;
      const auto& [a, b] = ends;
      drawn.emplace_back(glm::dvec3(a[0], a[1], a[2]), glm::dvec3(b[0], b[1], b[2]));
    }
  }
  return drawn;
}

}  // namespace focalstage
