#include "editor/tools/room_view.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace focalstage {

double depth_m(const RoomView& view, const glm::dvec3& world_m) {
  return -view.world_from_camera.inverse().point(world_m).z;
}

std::optional<glm::dvec2> pixel_of(const RoomView& view, const glm::dvec3& world_m) {
  const glm::dvec3 p = view.world_from_camera.inverse().point(world_m);
  if (!(-p.z >= view.near_m)) return std::nullopt;
  return view.centre_px + view.focal_px * glm::dvec2(p.x, -p.y) / -p.z;
}

Ray ray_through(const RoomView& view, const glm::dvec2& pixel) {
  const glm::dvec2 tangent = (pixel - view.centre_px) / view.focal_px;
  return {view.world_from_camera.position_m,
          view.world_from_camera.direction(glm::normalize(glm::dvec3(tangent.x, -tangent.y, -1.0)))};
}

double metres_per_px(const RoomView& view, const glm::dvec3& world_m) {
  return std::max(depth_m(view, world_m), view.near_m) / view.focal_px.y;
}

glm::dmat4 camera_from_world(const RoomView& view) { return view.world_from_camera.inverse().matrix(); }

glm::dmat4 clip_from_camera(const RoomView& view) {
  glm::dmat4 m(0.0);  // m[column][row]
  m[0][0] = 2.0 * view.focal_px.x / view.size_px.x;
  m[1][1] = 2.0 * view.focal_px.y / view.size_px.y;
  m[2][0] = 1.0 - 2.0 * view.centre_px.x / view.size_px.x;
  m[2][1] = 2.0 * view.centre_px.y / view.size_px.y - 1.0;
  m[2][2] = -(view.far_m + view.near_m) / (view.far_m - view.near_m);
  m[3][2] = -2.0 * view.far_m * view.near_m / (view.far_m - view.near_m);
  m[2][3] = -1.0;
  return m;
}

RoomView eye_view(const Eye& eye, const glm::dvec2& size_px, double fov_deg) {
  RoomView view;
  view.world_from_camera = eye.eye_from_world.inverse();
  view.size_px = size_px;
  view.focal_px = glm::dvec2(0.5 * size_px.x / std::tan(glm::radians(0.5 * fov_deg)));
  view.centre_px = 0.5 * size_px;
  return view;
}

RoomView projector_view(const ProjectorModel& projector, const glm::dvec2& size_px) {
  const glm::dvec2 picture_px(projector.width_px, projector.height_px);
  const double zoom = std::min(size_px.x / picture_px.x, size_px.y / picture_px.y);
  RoomView view;
  view.world_from_camera = projector.world_from_projector;
  view.size_px = size_px;
  view.focal_px = zoom * projector.focal_px;
  view.centre_px = zoom * projector.centre_px + 0.5 * (size_px - zoom * picture_px);
  return view;
}

}  // namespace focalstage
