#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/compile/tile.h"
#include "core/mesh/mesh.h"

namespace focalstage {

/// Bounds in a view, rounded outwards.
struct ViewBounds {
  Box box;
  float min_inverse_m;
  float max_inverse_m;
};

// Internal linkage on purpose, as in cells.h.
static inline Box hull(const Box& a, const Box& b) {
  return {std::min(a.min_x, b.min_x), std::min(a.min_y, b.min_y), std::max(a.max_x, b.max_x),
          std::max(a.max_y, b.max_y)};
}
static inline ViewBounds hull(const ViewBounds& a, const ViewBounds& b) {
  return {hull(a.box, b.box), std::min(a.min_inverse_m, b.min_inverse_m), std::max(a.max_inverse_m, b.max_inverse_m)};
}

/// The vertices of one mesh in view space. Each is projected once, for all the triangles that share it.
struct ViewPoints {
  std::vector<glm::dvec3> points_m;
  std::vector<ViewBounds> bounds;  ///< of each point alone; meaningless where it is nearer than the nearest
  double nearest_m = 0.0;
  bool all_in_front = false;  ///< no point is nearer than the nearest

  bool in_front(std::uint32_t i) const { return -points_m[i].z >= nearest_m; }
};

/// Places and projects all vertices of `mesh`. Keeps the memory that `view` already has.
void project_points(ViewPoints& view, const Mesh& mesh, const glm::dmat4& view_from_mesh, double nearest_m);

/// Bounds of a triangle that may reach nearer than the nearest: it is cut there. An empty box where nothing is left.
ViewBounds cut_bounds(const ViewPoints& view, const glm::uvec3& triangle);

/// Bounds of the part of a triangle that is at least the nearest distance away.
static inline ViewBounds front_bounds(const ViewPoints& view, const glm::uvec3& triangle) {
  if (!view.all_in_front) return cut_bounds(view, triangle);
  return hull(hull(view.bounds[triangle.x], view.bounds[triangle.y]), view.bounds[triangle.z]);
}

}  // namespace focalstage
