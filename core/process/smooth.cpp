#include "core/process/half_edge.h"  // before OpenMesh's tools, which do not include all they use

#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>

#include "core/mesh/circle.h"
#include "core/process/sculpt.h"
#include "core/process/vertices.h"

namespace focalstage {

namespace {

using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<HalfEdgeMesh>;

/// Vertices on a feature edge must not move.
void lock_features(HalfEdgeMesh& half_edges, double feature_deg) {
  const double cos_feature = sin_cos_deg(feature_deg).cos;
  half_edges.update_face_normals();
  for (const auto edge : half_edges.edges()) {
    if (half_edges.is_boundary(edge)) continue;
    const auto side = half_edges.halfedge_handle(edge, 0);
    const auto& one = half_edges.normal(half_edges.face_handle(side));
    const auto& other = half_edges.normal(half_edges.opposite_face_handle(side));
    if ((one | other) > cos_feature) continue;
    half_edges.status(half_edges.to_vertex_handle(side)).set_locked(true);
    half_edges.status(half_edges.from_vertex_handle(side)).set_locked(true);
  }
}

}  // namespace

Mesh smoothed(const Mesh& mesh, int rounds, double feature_deg) {
  HalfEdges made = half_edges_of(mesh);
  lock_features(made.mesh, feature_deg);
  Smoother smoother(made.mesh);
  smoother.initialize(Smoother::Tangential_and_Normal, Smoother::C0);
  smoother.smooth(static_cast<unsigned>(rounds));
  const Mesh moved = mesh_from(made.mesh);
  Mesh smooth = mesh_of_vertices(mesh, made.source, moved.triangles);
  smooth.positions_m = moved.positions_m;
  return smooth.normals.empty() ? smooth : with_normals(smooth);
}

}  // namespace focalstage
