#include "core/process/half_edge.h"

#include <OpenMesh/Core/System/omstream.hh>
#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "core/mesh/measure.h"

namespace focalstage {

namespace {

using VertexHandle = HalfEdgeMesh::VertexHandle;
using Corners = std::array<VertexHandle, 3>;

/// Makes half-edges, triangle by triangle.
class HalfEdgeMaker {
 public:
  explicit HalfEdgeMaker(const Mesh& mesh) : mesh_(mesh), place_of_(welded_indices(mesh)) {}

  HalfEdges make() {
    for (const glm::uvec3& triangle : mesh_.triangles) {
      if (!(triangle_area_m2(mesh_, triangle) > 0.0)) continue;
      Corners corners;
      for (int k = 0; k < 3; ++k) corners[static_cast<std::size_t>(k)] = shared(triangle[k]);
      if (fits(corners) && made_.mesh.add_face(corners[0], corners[1], corners[2]).is_valid()) continue;
      for (int k = 0; k < 3; ++k) corners[static_cast<std::size_t>(k)] = add(triangle[k]);
      made_.mesh.add_face(corners[0], corners[1], corners[2]);
    }
    return std::move(made_);
  }

 private:
  VertexHandle add(std::uint32_t vertex) {
    made_.source.push_back(vertex);
    return made_.mesh.add_vertex(vec_of(mesh_.positions_m[vertex]));
  }

  VertexHandle shared(std::uint32_t vertex) {
    const glm::dvec2 uv = mesh_.uvs.empty() ? glm::dvec2(0.0) : mesh_.uvs[vertex];
    const auto [entry, is_new] = shared_.try_emplace({place_of_[vertex], uv.x, uv.y});
    if (is_new) entry->second = add(vertex);
    return entry->second;
  }

  /// Each side is new, or has no triangle yet, and each corner has room for another one.
  bool fits(const Corners& corners) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!made_.mesh.is_boundary(corners[k])) return false;
      const auto side = made_.mesh.find_halfedge(corners[k], corners[(k + 1) % 3]);
      if (side.is_valid() && !made_.mesh.is_boundary(side)) return false;
    }
    return true;
  }

  const Mesh& mesh_;
  std::vector<std::uint32_t> place_of_;
  std::map<std::tuple<std::uint32_t, double, double>, VertexHandle> shared_;
  HalfEdges made_;
};

}  // namespace

OpenMesh::Vec3d vec_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
glm::dvec3 vec_of(const OpenMesh::Vec3d& v) { return {v[0], v[1], v[2]}; }

HalfEdges half_edges_of(const Mesh& mesh) {
  // What does not fit is ours to deal with; OpenMesh would tell the terminal.
  static const bool silent = (omerr().disable(), true);
  static_cast<void>(silent);
  return HalfEdgeMaker(mesh).make();
}

Mesh mesh_from(const HalfEdgeMesh& half_edges) {
  Mesh mesh;
  for (const auto vertex : half_edges.vertices()) mesh.positions_m.push_back(vec_of(half_edges.point(vertex)));
  for (const auto face : half_edges.faces()) {
    glm::uvec3 triangle;
    int k = 0;
    for (const auto vertex : half_edges.fv_range(face)) triangle[k++] = static_cast<std::uint32_t>(vertex.idx());
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace focalstage
