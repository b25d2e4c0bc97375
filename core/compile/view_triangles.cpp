#include "core/compile/view_triangles.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace focalstage {
namespace {

constexpr std::size_t chunk_size = 4096;
constexpr float infinity = std::numeric_limits<float>::infinity();

std::vector<glm::dvec3> transformed(const Mesh& mesh, const glm::dmat4& view_from_mesh) {
  std::vector<glm::dvec3> points(mesh.positions_m.size());
  const glm::dmat3 linear(view_from_mesh);
  const glm::dvec3 offset(view_from_mesh[3]);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 2 * chunk_size), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) points[i] = linear * mesh.positions_m[i] + offset;
  });
  return points;
}

void include(Box& box, double x, double y) {
  box.min_x = std::min(box.min_x, std::nextafter(static_cast<float>(x), -infinity));
  box.min_y = std::min(box.min_y, std::nextafter(static_cast<float>(y), -infinity));
  box.max_x = std::max(box.max_x, std::nextafter(static_cast<float>(x), infinity));
  box.max_y = std::max(box.max_y, std::nextafter(static_cast<float>(y), infinity));
}

/// Bounds of the part of a triangle that is at least `nearest_m` away.
Box front_box(const glm::dvec3* const corner[3], double nearest_m) {
  Box box{infinity, infinity, -infinity, -infinity};
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3& from = *corner[i];
    const glm::dvec3& to = *corner[(i + 1) % 3];
    const bool in_front = -from.z >= nearest_m;
    if (in_front) include(box, from.x / -from.z, from.y / -from.z);
    if (in_front != (-to.z >= nearest_m)) {
      const double share = (-nearest_m - from.z) / (to.z - from.z);
      const glm::dvec3 cut = from + (to - from) * share;
      include(box, cut.x / nearest_m, cut.y / nearest_m);
    }
  }
  return box;
}

bool apart(const Box& a, const Box& b) {
  return !(a.min_x <= b.max_x && b.min_x <= a.max_x && a.min_y <= b.max_y && b.min_y <= a.max_y);
}

/// The triple products of a triangle with corners in view space; false where the view sees it edge-on, from a side that
/// is left out, or not within `bounds`.
bool set_up_one(const glm::dvec3* const corner[3], double nearest_m, const Box& bounds, bool backs_hidden,
                ViewTriangle& out) {
  const glm::dvec3 normal[3] = {glm::cross(*corner[1], *corner[2]), glm::cross(*corner[2], *corner[0]),
                                glm::cross(*corner[0], *corner[1])};
  const double volume = glm::dot(normal[0], *corner[0]);  // negative: the front faces the view point
  if (volume == 0.0 || !std::isfinite(1.0 / volume) || (backs_hidden && volume > 0.0)) return false;
  out.box = front_box(corner, nearest_m);
  if (apart(out.box, bounds)) return false;
  // For a point z * (x, y, -1) of the triangle the products are z-free multiples of its weights with volume's sign.
  const double side = volume > 0.0 ? 1.0 : -1.0;
  for (int i = 0; i < 3; ++i) out.edge[i] = {normal[i].x * side, normal[i].y * side, -normal[i].z * side};
  const glm::dvec3 sum = (normal[0] + normal[1] + normal[2]) / volume;
  out.inverse_depth = {sum.x, sum.y, -sum.z};
  return true;
}

/// From outside a solid only fronts are seen; outside is certain where the view point lies beyond the solid's bounds.
bool seen_from_outside(const std::vector<glm::dvec3>& points, double nearest_m) {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high = -low;
  for (const glm::dvec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return high.z <= -nearest_m;
}

void append(const ViewDrawable& seen, std::uint32_t index, const Rigid& view_from_world, double nearest_m,
            const Box& bounds, std::vector<ViewTriangle>& out) {
  const Mesh& mesh = *seen.drawable->mesh;
  const std::vector<glm::dvec3> points = transformed(mesh, view_from_world.matrix() * seen.drawable->world_from_mesh);
  const bool mirrored = glm::determinant(glm::dmat3(seen.drawable->world_from_mesh)) < 0.0;
  const bool backs_hidden = seen.closed && !mirrored && seen_from_outside(points, nearest_m);

  const std::size_t chunks = (mesh.triangles.size() + chunk_size - 1) / chunk_size;
  std::vector<std::vector<ViewTriangle>> parts(chunks);
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
    const std::size_t end = std::min(mesh.triangles.size(), (chunk + 1) * chunk_size);
    for (std::size_t i = chunk * chunk_size; i < end; ++i) {
      const glm::uvec3& t = mesh.triangles[i];
      const glm::dvec3* const corner[3] = {&points[t.x], &points[t.y], &points[t.z]};
      ViewTriangle triangle;
      if (!set_up_one(corner, nearest_m, bounds, backs_hidden, triangle)) continue;
      triangle.drawable = index;
      triangle.triangle = static_cast<std::uint32_t>(i);
      parts[chunk].push_back(triangle);
    }
  });
  for (const auto& part : parts) out.insert(out.end(), part.begin(), part.end());
}

}  // namespace

ViewTriangles set_up(const std::vector<ViewDrawable>& drawables, const Rigid& view_from_world, double nearest_m,
                     const Box& bounds) {
  ViewTriangles view;
  view.nearest_m = nearest_m;
  for (std::uint32_t i = 0; i < drawables.size(); ++i) {
    append(drawables[i], i, view_from_world, nearest_m, bounds, view.triangles);
  }
  return view;
}

}  // namespace focalstage
