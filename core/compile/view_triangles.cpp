#include "core/compile/view_triangles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace focalstage {
namespace {

constexpr std::size_t chunk_size = 4096;

std::size_t chunks_of(const Mesh& mesh) { return (mesh.triangles.size() + chunk_size - 1) / chunk_size; }

bool apart(const Box& a, const Box& b) {
  return !(a.min_x <= b.max_x && b.min_x <= a.max_x && a.min_y <= b.max_y && b.min_y <= a.max_y);
}

/// Sets up one drawable into the places from `first`, a run per chunk of its triangles.
void append(const ViewDrawable& seen, std::uint32_t index, const Rigid& view_from_world, const Box& bounds,
            std::uint32_t first, std::size_t first_run, ViewTriangles& view) {
  const Mesh& mesh = *seen.drawable->mesh;
  ViewPoints& points = view.points;
  project_points(points, mesh, view_from_world.matrix() * seen.drawable->world_from_mesh, view.nearest_m);
  const bool mirrored = glm::determinant(glm::dmat3(seen.drawable->world_from_mesh)) < 0.0;
  // From outside a solid only fronts are seen; outside is certain where the view point lies beyond the solid's bounds.
  const bool backs_hidden = seen.solid && !mirrored && points.all_in_front;
  tbb::parallel_for(std::size_t{0}, chunks_of(mesh), [&](std::size_t chunk) {
    const std::size_t begin = chunk * chunk_size;
    const std::size_t end = std::min(mesh.triangles.size(), begin + chunk_size);
    auto place = static_cast<std::uint32_t>(first + begin);
    ViewTriangles::Run& run = view.runs[first_run + chunk];
    run.first = place;
    for (std::size_t i = begin; i < end; ++i) {
      ViewTriangle& triangle = view.triangles[place];
      if (!set_up_triangle(points, mesh.triangles[i], backs_hidden, triangle)) continue;
      view.bounds[place] = front_bounds(points, mesh.triangles[i]);
      if (apart(view.bounds[place].box, bounds)) continue;
      triangle.drawable = index;
      triangle.triangle = static_cast<std::uint32_t>(i);
      ++place;
    }
    run.count = place - run.first;
  });
}

}  // namespace

bool set_up_triangle(const ViewPoints& points, const glm::uvec3& corners, bool backs_hidden, ViewTriangle& out) {
  const glm::dvec3& a = points.points_m[corners.x];
  const glm::dvec3& b = points.points_m[corners.y];
  const glm::dvec3& c = points.points_m[corners.z];
  const glm::dvec3 normal[3] = {glm::cross(b, c), glm::cross(c, a), glm::cross(a, b)};
  const double volume = glm::dot(normal[0], a);  // negative: the front faces the view point
  if (volume == 0.0 || (backs_hidden && volume > 0.0)) return false;
  const double per_volume = 1.0 / volume;
  if (!std::isfinite(per_volume)) return false;
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
