#include "core/reference/view.h"

#include <utility>

#include <glm/geometric.hpp>

#include "core/mesh/smooth_parts.h"

namespace focalstage {
namespace {

template <class Thing>
Result<View> view_of_things(const std::vector<Thing>& things, const Rigid& view_from_world, double nearest_m) {
  std::vector<Face> faces;
  std::vector<SeenTriangle> corners_m;
  for (std::size_t thing = 0; thing < things.size(); ++thing) {
    for (std::size_t drawable = 0; drawable < things[thing].drawables.size(); ++drawable) {
      const Drawable& drawn = things[thing].drawables[drawable];
      const auto seen = [&](std::uint32_t vertex) {
        return view_from_world.point(
            glm::dvec3(drawn.world_from_mesh * glm::dvec4(drawn.mesh->positions_m[vertex], 1.0)));
      };
      for (std::size_t triangle = 0; triangle < drawn.mesh->triangles.size(); ++triangle) {
        const glm::uvec3& corner = drawn.mesh->triangles[triangle];
        faces.push_back({thing, drawable, triangle});
        corners_m.push_back({seen(corner.x), seen(corner.y), seen(corner.z)});
      }
    }
  }
  Result<Sight> sight = Sight::of(corners_m, nearest_m);
  if (!sight) return sight.fault();
  return View{std::move(faces), std::move(corners_m), *std::move(sight)};
}

}  // namespace

glm::dvec3 View::normal(std::size_t face) const {
  const auto& [a, b, c] = corners_m[face];
  return glm::cross(b - a, c - a);
}

Result<View> view_of(const std::vector<StagedSurface>& surfaces, const Rigid& view_from_world, double nearest_m) {
  return view_of_things(surfaces, view_from_world, nearest_m);
}

Result<View> view_of(const std::vector<StagedObject>& objects, const Rigid& view_from_world, double nearest_m) {
  return view_of_things(objects, view_from_world, nearest_m);
}

std::vector<double> part_depths_m(const std::vector<StagedSurface>& surfaces, const Rigid& view_from_world) {
  std::vector<double> depths_m;
  for (const StagedSurface& surface : surfaces) {
    for (const Drawable& drawn : surface.drawables) {
      const SmoothParts parts = placed(smooth_parts(*drawn.mesh), *drawn.mesh, drawn.world_from_mesh);
      for (const std::uint32_t part : parts.part_of_triangle) {
        depths_m.push_back(-view_from_world.point(parts.centre_m[part]).z);
      }
    }
  }
  return depths_m;
}

}  // namespace focalstage
