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

std::size_t chunks_of(const Mesh& mesh) { return (mesh.triangles.size() + chunk_size - 1) / chunk_size; }

void transform(const Mesh& mesh, const glm::dmat4& view_from_mesh, std::vector<glm::dvec3>& points) {
  points.resize(mesh.positions_m.size());
  const glm::dmat3 linear(view_from_mesh);
  const glm::dvec3 offset(view_from_mesh[3]);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 2 * chunk_size), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) points[i] = linear * mesh.positions_m[i] + offset;
  });
}

/// Takes a position into a box, a rounding error outwards.
void include(Box& box, double x, double y) {
  const auto fx = static_cast<float>(x);
  const auto fy = static_cast<float>(y);
  const float slack_x = std::abs(fx) * 1.2e-7f + 1e-30f;
  const float slack_y = std::abs(fy) * 1.2e-7f + 1e-30f;
  box.min_x = std::min(box.min_x, fx - slack_x);
  box.min_y = std::min(box.min_y, fy - slack_y);
  box.max_x = std::max(box.max_x, fx + slack_x);
  box.max_y = std::max(box.max_y, fy + slack_y);
}

/// Bounds of the part of a triangle that is at least `nearest_m` away.
TriangleBounds front_bounds(const glm::dvec3* const corner[3], double nearest_m) {
  TriangleBounds bounds{{infinity, infinity, -infinity, -infinity}, infinity, -infinity};
  const auto take_in = [&](const glm::dvec3& p, double inverse_m) {
    include(bounds.box, p.x * inverse_m, p.y * inverse_m);
    bounds.min_inverse_m = std::min(bounds.min_inverse_m, static_cast<float>(inverse_m));
    bounds.max_inverse_m = std::max(bounds.max_inverse_m, static_cast<float>(inverse_m));
  };
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3& from = *corner[i];
    const glm::dvec3& to = *corner[(i + 1) % 3];
    const bool in_front = -from.z >= nearest_m;
    if (in_front) take_in(from, 1.0 / -from.z);
    if (in_front != (-to.z >= nearest_m)) {
      const double share = (-nearest_m - from.z) / (to.z - from.z);
      take_in(from + (to - from) * share, 1.0 / nearest_m);
    }
  }
  return bounds;
}

bool apart(const Box& a, const Box& b) {
  return !(a.min_x <= b.max_x && b.min_x <= a.max_x && a.min_y <= b.max_y && b.min_y <= a.max_y);
}

/// The triple products of a triangle with corners in view space; false where the view sees it edge-on, from a side that
/// is left out, or not within `bounds`.
bool set_up_one(const glm::dvec3* const corner[3], double nearest_m, const Box& bounds, bool backs_hidden,
                ViewTriangle& out, TriangleBounds& out_bounds) {
  const glm::dvec3 normal[3] = {glm::cross(*corner[1], *corner[2]), glm::cross(*corner[2], *corner[0]),
                                glm::cross(*corner[0], *corner[1])};
  const double volume = glm::dot(normal[0], *corner[0]);  // negative: the front faces the view point
  if (volume == 0.0 || (backs_hidden && volume > 0.0)) return false;
  const double per_volume = 1.0 / volume;
  if (!std::isfinite(per_volume)) return false;
  out_bounds = front_bounds(corner, nearest_m);
  if (apart(out_bounds.box, bounds)) return false;
  // For a point z * (x, y, -1) of the triangle the products are its weights times volume / z: give them volume's sign.
  const double side = volume > 0.0 ? 1.0 : -1.0;
  for (int i = 0; i < 3; ++i) {
    out.a[i] = normal[i].x * side;
    out.b[i] = normal[i].y * side;
    out.c[i] = -normal[i].z * side;
  }
  const glm::dvec3 sum = (normal[0] + normal[1] + normal[2]) * per_volume;
  out.a[3] = sum.x;
  out.b[3] = sum.y;
  out.c[3] = -sum.z;
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

/// Sets up one drawable into the places from `first`, a run per chunk of its triangles.
void append(const ViewDrawable& seen, std::uint32_t index, const Rigid& view_from_world, const Box& bounds,
            std::uint32_t first, std::size_t first_run, ViewTriangles& view) {
  const Mesh& mesh = *seen.drawable->mesh;
  std::vector<glm::dvec3> points;
  transform(mesh, view_from_world.matrix() * seen.drawable->world_from_mesh, points);
  const bool mirrored = glm::determinant(glm::dmat3(seen.drawable->world_from_mesh)) < 0.0;
  const bool backs_hidden = seen.solid && !mirrored && seen_from_outside(points, view.nearest_m);
  tbb::parallel_for(std::size_t{0}, chunks_of(mesh), [&](std::size_t chunk) {
    const std::size_t begin = chunk * chunk_size;
    const std::size_t end = std::min(mesh.triangles.size(), begin + chunk_size);
    auto place = static_cast<std::uint32_t>(first + begin);
    ViewTriangles::Run& run = view.runs[first_run + chunk];
    run.first = place;
    for (std::size_t i = begin; i < end; ++i) {
      const glm::uvec3& t = mesh.triangles[i];
      const glm::dvec3* const corner[3] = {&points[t.x], &points[t.y], &points[t.z]};
      ViewTriangle& triangle = view.triangles[place];
      if (!set_up_one(corner, view.nearest_m, bounds, backs_hidden, triangle, view.bounds[place])) continue;
      triangle.drawable = index;
      triangle.triangle = static_cast<std::uint32_t>(i);
      ++place;
    }
    run.count = place - run.first;
  });
}

}  // namespace

bool ViewTriangles::empty() const {
  return std::all_of(runs.begin(), runs.end(), [](const Run& run) { return run.count == 0; });
}

void set_up(ViewTriangles& view, const std::vector<ViewDrawable>& drawables, const Rigid& view_from_world,
            double nearest_m, const Box& bounds) {
  std::size_t places = 0;
  std::size_t runs = 0;
  for (const ViewDrawable& seen : drawables) {
    places += seen.drawable->mesh->triangles.size();
    runs += chunks_of(*seen.drawable->mesh);
  }
  if (view.triangles.size() < places) {
    view.triangles.resize(places);
    view.bounds.resize(places);
  }
  view.runs.assign(runs, {0, 0});
  view.nearest_m = nearest_m;
  std::uint32_t first = 0;
  std::size_t first_run = 0;
  for (std::uint32_t i = 0; i < drawables.size(); ++i) {
    append(drawables[i], i, view_from_world, bounds, first, first_run, view);
    first += static_cast<std::uint32_t>(drawables[i].drawable->mesh->triangles.size());
    first_run += chunks_of(*drawables[i].drawable->mesh);
  }
}

}  // namespace focalstage
