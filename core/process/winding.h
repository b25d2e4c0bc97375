#pragma once

#include "core/mesh/edges.h"
#include "core/mesh/mesh.h"

namespace focalstage {

/// Every triangle, and every normal, looks the other way.
Mesh flipped(const Mesh& mesh);

/// Neighbours wind alike; what is closed looks outwards, what is open as the larger share of its area did. Where that
/// cannot be (a band with a half turn) some neighbours stay against each other. Normals follow their triangles; a
/// vertex between triangles that turn and such that don't comes apart.
Mesh evenly_wound(const Mesh& mesh);

/// How many edges have two triangles that run along them the same way.
std::size_t edges_against(const Edges& edges);

/// For each group of triangles whether it is closed: every edge has two triangles.
std::vector<bool> closed_groups(const Edges& edges, const TriangleGroups& groups);

/// For each group the volume inside, as far as it is closed and evenly wound: negative where it looks inwards.
std::vector<double> group_volumes_m3(const Mesh& mesh, const TriangleGroups& groups);

}  // namespace focalstage
