#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"

namespace focalstage {

/// A mesh of some vertices of another, with all that these carry, in the order given.
Mesh mesh_of_vertices(const Mesh& mesh, std::span<const std::uint32_t> vertices, std::vector<glm::uvec3> triangles);

/// Only the triangles that are kept, and the vertices that they use, in their order.
Mesh mesh_of_triangles(const Mesh& mesh, const std::vector<bool>& kept);

/// With normals made anew: each the sum of the areas around it, as far as no edge is in between where triangles meet at
/// 45 degrees or more, or wind against each other. Vertices on such creases come apart.
Mesh with_normals(const Mesh& mesh);

}  // namespace focalstage
