#pragma once

#include <glm/vec3.hpp>

#include "core/mesh/implicit.h"
#include "core/mesh/mesh.h"

namespace focalstage {

/// A grid of cubes from `min_m`, `count` of them along each axis.
struct SampleGrid {
  glm::dvec3 min_m;
  double cell_m;
  glm::uvec3 count;
};

/// The zero surface of a solid that lies wholly inside the grid, closed and two-manifold whatever the field does
/// between samples: six tetrahedra a cube around its main diagonal, split alike on both sides of every face. Vertices
/// lie on the surface to rounding, evened out along it; normals are the field's gradient. Triangles wind outwards.
Mesh polygonise(const BlendedSolid& solid, const SampleGrid& grid);

}  // namespace focalstage
