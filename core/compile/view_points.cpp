#include "core/compile/view_points.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace focalstage {
namespace {

constexpr std::size_t block_size = 8192;
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Bounds of one position: a rounding error to each side.
ViewBounds bounds_of(const glm::dvec3& point_m, double inverse_m) {
  const auto x = static_cast<float>(point_m.x * inverse_m);
  const auto y = static_cast<float>(point_m.y * inverse_m);
  const float slack_x = std::abs(x) * 1.2e-7f + 1e-30f;
  const float slack_y = std::abs(y) * 1.2e-7f + 1e-30f;
  const auto inverse = static_cast<float>(inverse_m);
  return {{x - slack_x, y - slack_y, x + slack_x, y + slack_y}, inverse, inverse};
}

}  // namespace

ViewBounds cut_bounds(const ViewPoints& view, const glm::uvec3& triangle) {
  ViewBounds bounds{{infinity, infinity, -infinity, -infinity}, infinity, -infinity};
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t from = triangle[i];
    const std::uint32_t to = triangle[(i + 1) % 3];
    if (view.in_front(from)) bounds = hull(bounds, view.bounds[from]);
    if (view.in_front(from) == view.in_front(to)) continue;
    const glm::dvec3& start = view.points_m[from];
    const glm::dvec3& end = view.points_m[to];
    const double share = (-view.nearest_m - start.z) / (end.z - start.z);
    bounds = hull(bounds, bounds_of(start + (end - start) * share, 1.0 / view.nearest_m));
  }
  return bounds;
}

void project_points(ViewPoints& view, const Mesh& mesh, const glm::dmat4& view_from_mesh, double nearest_m) {
  view.points_m.resize(mesh.positions_m.size());
  view.bounds.resize(mesh.positions_m.size());
  view.nearest_m = nearest_m;
  const glm::dmat3 linear(view_from_mesh);
  const glm::dvec3 offset(view_from_mesh[3]);
  std::atomic<bool> all_in_front = true;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, view.points_m.size(), block_size), [&](const auto& range) {
    bool in_front = true;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const glm::dvec3 point_m = linear * mesh.positions_m[i] + offset;
      view.points_m[i] = point_m;
      view.bounds[i] = bounds_of(point_m, 1.0 / -point_m.z);
      in_front = in_front && -point_m.z >= nearest_m;
    }
    if (!in_front) all_in_front = false;
  });
  view.all_in_front = all_in_front;
}

}  // namespace focalstage
