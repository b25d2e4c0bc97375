#pragma once

#include <cstdint>
#include <vector>

#include "core/compile/view_points.h"
#include "core/stage/stage.h"

namespace focalstage {

// The geometry stage: triangles as seen from one point, ready to be asked "which of you is nearest along this look?".
//
// A look (x, y) is the direction (x, y, -1) in view space. With a triangle's corners V0 V1 V2 in view space, the triple
// products e_i = (V_j x V_k) . (x, y, -1) are affine in the look, carry the sign of the side on which it passes edge i,
// and are the barycentric weights up to a common factor; their sum over the triple product of the corners is 1/depth.
// So one set-up serves coverage, depth and interpolation, holds for corners behind the viewer too (no clipping), and
// two triangles that share an edge get exactly opposite values, so that no look slips between them.

/// One triangle of a view: four functions a * look.x + b * look.y + c of the look, side by side so that one vector
/// instruction moves all of them to a tile. 0 to 2: the triple products of the edges, none negative inside. 3: 1 /
/// distance along the axis, from the view point.
struct alignas(32) ViewTriangle {
  double a[4];
  double b[4];
  double c[4];
  std::uint32_t drawable;  ///< in the list given
  std::uint32_t triangle;  ///< in the drawable's mesh

  double edge(int i, double look_x, double look_y) const { return a[i] * look_x + b[i] * look_y + c[i]; }
  double inverse_depth(double look_x, double look_y) const { return edge(3, look_x, look_y); }
};

/// A drawable and what a view must know of it.
struct ViewDrawable {
  const Drawable* drawable = nullptr;
  bool solid = false;       ///< bounds a solid: backs can be left out when seen from outside
  std::uint32_t owner = 0;  ///< object or surface, in the stage's list
};

/// All drawables of a stage's objects or surfaces, none of them taken for solid.
template <class Thing>
std::vector<ViewDrawable> drawables_of(const std::vector<Thing>& things) {
  std::vector<ViewDrawable> all;
  for (std::size_t i = 0; i < things.size(); ++i) {
    for (const Drawable& drawable : things[i].drawables) {
      all.push_back({&drawable, false, static_cast<std::uint32_t>(i)});
    }
  }
  return all;
}

/// The triangles of a view. They stand in runs with unused places between, as their makers on several threads left
/// them; an index names a place.
struct ViewTriangles {
  struct Run {
    std::uint32_t first;
    std::uint32_t count;
  };

  std::vector<ViewTriangle> triangles;
  std::vector<ViewBounds> bounds;
  std::vector<Run> runs;
  double nearest_m = 0.0;  ///< looks pass through what is nearer than this
  ViewPoints points;       ///< of the drawable set up last: memory to work in

  bool empty() const;
};

/// The triple products of a triangle with corners in view space; false where the view sees it edge-on or, with
/// `backs_hidden`, from behind.
bool set_up_triangle(const ViewPoints& points, const glm::uvec3& corners, bool backs_hidden, ViewTriangle& out);

/// Sets up all triangles that can be met within `bounds`, in the order of the drawables and their meshes, on as many
/// threads as the caller's arena has. Keeps the memory that `view` already has.
void set_up(ViewTriangles& view, const std::vector<ViewDrawable>& drawables, const Rigid& view_from_world,
            double nearest_m, const Box& bounds);

}  // namespace focalstage
