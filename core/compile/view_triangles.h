#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/compile/tile.h"
#include "core/stage/stage.h"

namespace focalstage {

// The geometry stage: triangles as seen from one point, ready to be asked "which of you is nearest along this look?".
//
// A look (x, y) is the direction (x, y, -1) in view space. With a triangle's corners V0 V1 V2 in view space, the triple
// products e_i = (V_j x V_k) . (x, y, -1) are affine in the look, carry the sign of the side on which it passes edge i,
// and are the barycentric weights up to a common factor; their sum over the triple product of the corners is 1/depth.
// So one set-up serves coverage, depth and interpolation, holds for corners behind the viewer too (no clipping), and
// two triangles that share an edge get exactly opposite values, so that no look slips between them.

/// x * look.x + y * look.y + constant.
struct Affine {
  double x, y, constant;

  double at(double look_x, double look_y) const { return x * look_x + y * look_y + constant; }
};

/// One triangle of a view.
struct ViewTriangle {
  Affine edge[3];          ///< inside: none is negative
  Affine inverse_depth;    ///< 1 / distance along the axis, from the view point
  Box box;                 ///< of its part in front, rounded outwards
  std::uint32_t drawable;  ///< in the list given
  std::uint32_t triangle;  ///< in the drawable's mesh
};

/// A drawable and what a view must know of it.
struct ViewDrawable {
  const Drawable* drawable = nullptr;
  bool closed = false;      ///< bounds a solid: backs can be left out when seen from outside
  std::uint32_t owner = 0;  ///< object or surface, in the stage's list
};

struct ViewTriangles {
  std::vector<ViewTriangle> triangles;
  double nearest_m = 0.0;  ///< looks pass through what is nearer than this
};

/// Sets up all triangles that can be met within `bounds`, in the order of the drawables and their meshes, on as many
/// threads as the caller's arena has.
ViewTriangles set_up(const std::vector<ViewDrawable>& drawables, const Rigid& view_from_world, double nearest_m,
                     const Box& bounds);

}  // namespace focalstage
