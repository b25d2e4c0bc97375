#include "core/stage/texture_maps.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "core/mesh/measure.h"

namespace focalstage {

namespace {

constexpr double least_facing = 0.1;  ///< of a thing's areas: less faces no side
constexpr double most_level = 0.99;   ///< a plane that lies flatter has no upright in the room

struct Faced {
  glm::dvec3 doubled_area{0.0};  ///< as vectors, summed
  double doubled_all = 0.0;
  Bounds bounds;
};

template <class Visit>
void each_corner(const std::vector<Drawable>& drawables, Visit&& visit) {
  for (const Drawable& drawable : drawables) {
    for (const glm::uvec3& t : drawable.mesh->triangles) {
      glm::dvec3 corners_m[3];
      for (int k = 0; k < 3; ++k) {
        corners_m[k] = glm::dvec3(drawable.world_from_mesh * glm::dvec4(drawable.mesh->positions_m[t[k]], 1.0));
      }
      visit(corners_m);
    }
  }
}

Faced faced_by(const std::vector<Drawable>& drawables) {
  Faced faced;
  each_corner(drawables, [&](const glm::dvec3(&corners_m)[3]) {
    const glm::dvec3 area = doubled_area(corners_m[0], corners_m[1], corners_m[2]);
    faced.doubled_area += area;
    faced.doubled_all += glm::length(area);
    for (const glm::dvec3& corner_m : corners_m) faced.bounds.include(corner_m);
  });
  return faced;
}

/// A plane that looks along `normal`, upright.
glm::dquat turned_to(const glm::dvec3& normal) {
  const glm::dvec3 upwards = std::abs(normal.y) < most_level ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, -1.0);
  const glm::dvec3 right = glm::normalize(glm::cross(upwards, normal));
  return glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(normal, right), normal)));
}

}  // namespace

UvPlaneStep facing_plane(const std::vector<Drawable>& drawables, const Rigid& world_from_thing,
                         const glm::dvec3& seen_from_m) {
  const Faced faced = faced_by(drawables);
  const glm::dvec3 middle_m = 0.5 * (faced.bounds.min_m + faced.bounds.max_m);
  const bool has_side = glm::length(faced.doubled_area) > least_facing * faced.doubled_all;
  const glm::dvec3 towards = has_side ? faced.doubled_area : seen_from_m - middle_m;
  Rigid world_from_plane;
  if (glm::length(towards) > 0.0) world_from_plane.rotation = turned_to(glm::normalize(towards));
  Bounds seen;
  const Rigid plane_from_world = world_from_plane.inverse();
  each_corner(drawables, [&](const glm::dvec3(&corners_m)[3]) {
    for (const glm::dvec3& corner_m : corners_m) seen.include(plane_from_world.point(corner_m));
  });
  UvPlaneStep step;
  const glm::dvec2 size_m(seen.size_m());
  if (size_m.x > 0.0 && size_m.y > 0.0) {
    step.size_m = size_m;
    world_from_plane.position_m = world_from_plane.point(0.5 * (seen.min_m + seen.max_m));
  }
  step.pose = world_from_thing.inverse() * world_from_plane;
  return step;
}

UvProjectorStep thrown_by(const Projector& projector, const Rigid& world_from_thing) {
  return {world_from_thing.inverse() * projector.pose,
          projector.width_px,
          projector.height_px,
          projector.fx_px,
          projector.fy_px,
          projector.cx_px,
          projector.cy_px};
}

}  // namespace focalstage
