#pragma once

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/base/result.h"
#include "core/mesh/mesh.h"

namespace focalstage {

/// The smallest axis-aligned box around some points; `min_m` above `max_m` where there are none.
struct Bounds {
  glm::dvec3 min_m{1.0};
  glm::dvec3 max_m{-1.0};

  bool empty() const { return min_m.x > max_m.x; }
  void include(const glm::dvec3& point_m) {
    *this = empty() ? Bounds{point_m, point_m} : Bounds{glm::min(min_m, point_m), glm::max(max_m, point_m)};
  }
  glm::dvec3 size_m() const {
    if (empty()) return glm::dvec3(0.0);
    return max_m - min_m;
  }
};

/// Around the positions that triangles use.
Bounds mesh_bounds(const Mesh& mesh);

/// Twice the area as a vector along the front's normal; its length is zero for a degenerate triangle.
glm::dvec3 doubled_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// The same of one of a mesh's triangles.
glm::dvec3 doubled_area(const Mesh& mesh, const glm::uvec3& triangle);

double triangle_area_m2(const Mesh& mesh, const glm::uvec3& triangle);

/// Sum of all triangles' areas.
double mesh_area_m2(const Mesh& mesh);

/// The volume inside a closed mesh, positive where triangles wind outwards.
double enclosed_volume_m3(const Mesh& mesh);

/// Whether every edge has exactly two triangles that run along it in opposite directions; corners at the same position
/// count as one, and triangles without three corners do not count.
bool is_closed(const Mesh& mesh);

/// Indices in range, per-vertex lists of the right length, every number finite. Code "mesh.invalid".
Status check_mesh(const Mesh& mesh);

/// For each position the index of the first one that equals it (0 and -0 are equal).
std::vector<std::uint32_t> welded_indices(const Mesh& mesh);

}  // namespace focalstage
