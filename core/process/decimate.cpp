#include "core/process/half_edge.h"  // before OpenMesh's tools, which do not include all they use

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModHausdorffT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>

#include "core/process/sculpt.h"
#include "core/process/vertices.h"

namespace focalstage {

namespace {

using Decimater = OpenMesh::Decimater::DecimaterT<HalfEdgeMesh>;
using Quadric = OpenMesh::Decimater::ModQuadricT<HalfEdgeMesh>;
using Hausdorff = OpenMesh::Decimater::ModHausdorffT<HalfEdgeMesh>;
using NormalFlipping = OpenMesh::Decimater::ModNormalFlippingT<HalfEdgeMesh>;

constexpr double most_turn_deg = 30.0;  ///< of a triangle whose corner moves: slivers would look anywhere

void collapse(HalfEdgeMesh& half_edges, std::optional<std::size_t> triangles, std::optional<double> error_m) {
  Decimater decimater(half_edges);
  Quadric::Handle quadric;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();  // it orders, it does not forbid
  NormalFlipping::Handle flipping;
  decimater.add(flipping);
  decimater.module(flipping).set_max_normal_deviation(most_turn_deg);
  Hausdorff::Handle hausdorff;
  if (error_m) {
    decimater.add(hausdorff);
    decimater.module(hausdorff).set_tolerance(*error_m);
  }
  if (!decimater.initialize()) return;
  if (triangles) {
    decimater.decimate_to_faces(0, *triangles);
  } else {
    decimater.decimate();
  }
}

}  // namespace

Mesh decimated(const Mesh& mesh, std::optional<std::size_t> triangles, std::optional<double> error_m) {
  HalfEdges made = half_edges_of(mesh);
  HalfEdgeMesh& half_edges = made.mesh;
  half_edges.update_face_normals();
  for (const auto vertex : half_edges.vertices()) half_edges.status(vertex).set_locked(half_edges.is_boundary(vertex));
  collapse(half_edges, triangles, error_m);
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> new_place(half_edges.n_vertices());
  for (const auto vertex : half_edges.vertices()) {
    const auto at = static_cast<std::size_t>(vertex.idx());
    if (half_edges.status(vertex).deleted()) continue;
    new_place[at] = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(made.source[at]);
  }
  std::vector<glm::uvec3> left;
  for (const auto face : half_edges.faces()) {
    glm::uvec3 triangle;
    int k = 0;
    for (const auto vertex : half_edges.fv_range(face))
      triangle[k++] = new_place[static_cast<std::size_t>(vertex.idx())];
    left.push_back(triangle);
  }
  Mesh coarse = mesh_of_vertices(mesh, vertices, std::move(left));
  return coarse.normals.empty() ? coarse : with_normals(coarse);
}

}  // namespace focalstage
