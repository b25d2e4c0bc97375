#include "core/stage/deviation.h"

#include <algorithm>

#include "core/stage/nearest_surface.h"

namespace focalstage {

namespace {

glm::dvec3 placed(const Drawable& drawable, std::uint32_t vertex) {
  return glm::dvec3(drawable.world_from_mesh * glm::dvec4(drawable.mesh->positions_m[vertex], 1.0));
}

NearestSurface surface_of(const std::vector<Drawable>& drawables) {
  std::vector<NearestSurface::Triangle> triangles;
  for (const Drawable& drawable : drawables) {
    for (const glm::uvec3& t : drawable.mesh->triangles) {
      triangles.push_back({placed(drawable, t.x), placed(drawable, t.y), placed(drawable, t.z)});
    }
  }
  return NearestSurface(std::move(triangles));
}

std::vector<bool> used_vertices(const Mesh& mesh) {
  std::vector<bool> used(mesh.positions_m.size());
  for (const glm::uvec3& t : mesh.triangles) used[t.x] = used[t.y] = used[t.z] = true;
  return used;
}

/// Of each vertex of some drawables from a surface; `visit` sees those that count.
template <class Visit>
std::vector<std::vector<double>> distances_m(const std::vector<Drawable>& drawables, const NearestSurface& surface,
                                             Visit&& visit) {
  std::vector<std::vector<double>> all;
  for (const Drawable& drawable : drawables) {
    const std::vector<bool> used = used_vertices(*drawable.mesh);
    std::vector<double>& of_mesh = all.emplace_back(used.size(), 0.0);
    for (std::uint32_t i = 0; i < used.size(); ++i) {
      if (!used[i]) continue;
      of_mesh[i] = surface.distance_m(placed(drawable, i));
      visit(of_mesh[i]);
    }
  }
  return all;
}

}  // namespace

Deviation deviation_of(const std::vector<Drawable>& before, const std::vector<Drawable>& after) {
  Deviation deviation;
  double sum_m = 0.0;
  std::size_t count = 0;
  deviation.of_vertex_m = distances_m(after, surface_of(before), [&](double distance_m) {
    sum_m += distance_m;
    ++count;
    deviation.worst_m = std::max(deviation.worst_m, distance_m);
  });
  deviation.mean_m = count > 0 ? sum_m / static_cast<double>(count) : 0.0;
  distances_m(before, surface_of(after),
              [&](double distance_m) { deviation.worst_lost_m = std::max(deviation.worst_lost_m, distance_m); });
  return deviation;
}

}  // namespace focalstage
