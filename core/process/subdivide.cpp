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

/// Texture coordinates through the weights of the positions: the same half-edges, standing where the texture says.
std::vector<glm::dvec2> subdivided_uvs(const Mesh& mesh, HalfEdges made, Subdivision scheme, int rounds) {
  for (const auto vertex : made.mesh.vertices()) {
    const glm::dvec2& uv = mesh.uvs[made.source[static_cast<std::size_t>(vertex.idx())]];
    made.mesh.set_point(vertex, {uv.x, uv.y, 0.0});
  }
  subdivide(made.mesh, scheme, rounds);
  std::vector<glm::dvec2> uvs;
  for (const auto vertex : made.mesh.vertices()) uvs.emplace_back(vec_of(made.mesh.point(vertex)));
  return uvs;
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
  HalfEdges made = half_edges_of(mesh);
  HalfEdges for_uvs = made;
  subdivide(made.mesh, scheme, rounds);
  Mesh fine = mesh_from(made.mesh);
  if (!mesh.uvs.empty()) fine.uvs = subdivided_uvs(mesh, std::move(for_uvs), scheme, rounds);
  return mesh.normals.empty() ? fine : with_normals(fine);
}

}  // namespace focalstage
