#include "tests/bench/views.h"

#include <algorithm>
#include <vector>

#include <glm/common.hpp>

#include "core/optics/look.h"

namespace focalstage::bench {
namespace {

constexpr double near_m = 0.016;
constexpr double far_m = 100.0;

/// Where the corners of the image meet the nearest and farthest planes on which the surfaces lie.
std::vector<glm::dvec3> lit_corners(const BenchScene& scene) {
  const Rigid& world_from_projector = scene.settings.projector.world_from_projector;
  double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
  for (const StagedSurface& surface : scene.stage.surfaces) {
    for (const Drawable& drawable : surface.drawables) {
      for (const glm::dvec3& position : drawable.mesh->positions_m) {
        const double z = (drawable.world_from_mesh * glm::dvec4(position, 1.0)).z;
        low_m = std::min(low_m, z);
        high_m = std::max(high_m, z);
      }
    }
  }
  std::vector<glm::dvec3> corners;
  const ProjectorModel& projector = scene.settings.projector;
  for (const double x : {0, projector.width_px}) {
    for (const double y : {0, projector.height_px}) {
      const glm::dvec3 ray = world_from_projector.direction({tangent_of_pixel(projector, {x, y}), -1.0});
      for (const double z : {low_m, high_m}) {
        corners.push_back(world_from_projector.position_m + ray * ((z - world_from_projector.position_m.z) / ray.z));
      }
    }
  }
  return corners;
}

}  // namespace

Window window_of(const BenchScene& scene, const Eye& eye) {
  Window window;
  for (const glm::dvec3& world_m : lit_corners(scene)) {
    const glm::dvec3 point_m = eye.eye_from_world.point(world_m);
    for (const double power_d : scene.settings.slices.powers_d) {
      const glm::dvec2 look =
          straight_look(point_m) * look_stretch(power_d, -point_m.z - eye.lens_to_pupil_m, eye.lens_to_pupil_m);
      window.low = glm::min(window.low, look);
      window.high = glm::max(window.high, look);
    }
  }
  const glm::dvec2 margin = 0.01 * (window.high - window.low);
  return {window.low - margin, window.high + margin};
}

glm::dmat4 clip_from_eye(const Window& window) {
  const glm::dvec2 size = window.high - window.low, sum = window.high + window.low;
  glm::dmat4 clip(0.0);
  clip[0][0] = 2.0 / size.x;
  clip[1][1] = 2.0 / size.y;
  clip[2] = {sum.x / size.x, sum.y / size.y, -(far_m + near_m) / (far_m - near_m), -1.0};
  clip[3][2] = -2.0 * far_m * near_m / (far_m - near_m);
  return clip;
}

glm::dmat4 clip_from_projector(const ProjectorModel& projector) {
  glm::dmat4 clip(0.0);
  clip[0][0] = 2.0 * projector.focal_px.x / projector.width_px;
  clip[1][1] = -2.0 * projector.focal_px.y / projector.height_px;
  clip[2] = {1.0 - 2.0 * projector.centre_px.x / projector.width_px,
             1.0 - 2.0 * projector.centre_px.y / projector.height_px, -(far_m + near_m) / (far_m - near_m), -1.0};
  clip[3][2] = -2.0 * far_m * near_m / (far_m - near_m);
  return clip;
}

}  // namespace focalstage::bench
