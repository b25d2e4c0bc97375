#pragma once

#include <OpenMesh/Core/Mesh/Traits.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cstdint>
#include <vector>

#include "core/mesh/mesh.h"

// OpenMesh lives in the .cpp files of this room and nowhere else.
namespace focalstage {

struct HalfEdgeTraits : OpenMesh::DefaultTraitsDouble {
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge | OpenMesh::Attributes::Status);
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits>;

/// A mesh as half-edges, and where each of its vertices comes from. Vertices in one place with one texture coordinate
/// are one; where sheets share an edge or a corner that half-edges cannot hold, each has its own. Triangles without
/// area are left out.
struct HalfEdges {
  HalfEdgeMesh mesh;
  std::vector<std::uint32_t> source;  ///< the vertex of the mesh, for each of these
};

HalfEdges half_edges_of(const Mesh& mesh);

/// Places and triangles of what is left.
Mesh mesh_from(const HalfEdgeMesh& half_edges);

OpenMesh::Vec3d vec_of(const glm::dvec3& v);
glm::dvec3 vec_of(const OpenMesh::Vec3d& v);

}  // namespace focalstage
