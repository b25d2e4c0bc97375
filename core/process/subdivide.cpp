#include "core/process/half_edge.h"  // before OpenMesh's tools, which do not include all they use

#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/Sqrt3T.hh>
#include <string>

#include "core/process/sculpt.h"
#include "core/process/vertices.h"

namespace focalstage {

namespace {

void subdivide(HalfEdgeMesh& half_edges, Subdivision scheme, int rounds) {
  const auto times = static_cast<std::size_t>(rounds);
  if (scheme == Subdivision::loop) {
    OpenMesh::Subdivider::Uniform::LoopT<HalfEdgeMesh, double> subdivider;
    subdivider(half_edges, times);
  } else {
    OpenMesh::Subdivider::Uniform::Sqrt3T<HalfEdgeMesh, double> subdivider;
    subdivider(half_edges, times);
  }
}

/// What vertices carry, through the weights of the positions: the same half-edges, standing where `carried` says.
template <class Carried>
std::vector<glm::dvec3> subdivided_values(HalfEdges made, const Carried& carried, Subdivision scheme, int rounds) {
  for (const auto vertex : made.mesh.vertices()) {
    made.mesh.set_point(vertex, vec_of(carried(made.source[static_cast<std::size_t>(vertex.idx())])));
  }
  subdivide(made.mesh, scheme, rounds);
  std::vector<glm::dvec3> values;
  for (const auto vertex : made.mesh.vertices()) values.push_back(vec_of(made.mesh.point(vertex)));
  return values;
}

}  // namespace

Result<Mesh> subdivided(const Mesh& mesh, Subdivision scheme, int rounds) {
  std::size_t triangles = mesh.triangles.size();
  for (int i = 0; i < rounds && triangles <= most_processed_triangles; ++i) {
    triangles *= scheme == Subdivision::loop ? 4 : 3;
  }
  if (triangles > most_processed_triangles) {
    return Fault{"process.too-large", "rounds",
                 std::to_string(mesh.triangles.size()) + " triangles become more than " +
                     std::to_string(most_processed_triangles),
                 "use fewer rounds, or decimate before"};
  }
  const HalfEdges coarse = half_edges_of(mesh);
  HalfEdgeMesh half_edges = coarse.mesh;
  subdivide(half_edges, scheme, rounds);
  Mesh fine = mesh_from(half_edges);
  if (!mesh.uvs.empty()) {
    const auto uv = [&](std::uint32_t vertex) { return glm::dvec3(mesh.uvs[vertex], 0.0); };
    for (const glm::dvec3& value : subdivided_values(coarse, uv, scheme, rounds)) fine.uvs.emplace_back(value);
  }
  if (!mesh.colors.empty()) {
    fine.colors = subdivided_values(
        coarse, [&](std::uint32_t vertex) { return mesh.colors[vertex]; }, scheme, rounds);
  }
  return mesh.normals.empty() ? fine : with_normals(fine);
}

}  // namespace focalstage
