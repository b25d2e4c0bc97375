#pragma once

#include <vector>

#include "core/mesh/mesh.h"

namespace focalstage {

/// Vertices nearer to each other than `tolerance_m` move to the first of them, and become one where they carry the same
/// normal, texture coordinates and colour. Triangles with two corners in one place go.
Mesh welded(const Mesh& mesh, double tolerance_m);

/// Triangles without area, and all but the first of those with the same three places for corners, go; so do vertices
/// that no triangle uses.
Mesh cleaned(const Mesh& mesh);

/// Which triangles `cleaned` takes away, and why.
struct Unclean {
  std::vector<bool> no_area;
  std::vector<bool> repeated;
};
Unclean unclean_triangles(const Mesh& mesh);

}  // namespace focalstage
