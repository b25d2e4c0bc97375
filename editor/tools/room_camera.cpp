#include "editor/tools/room_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace focalstage {
namespace {

constexpr double half_fov_deg = 19.0;  // of the shorter side
constexpr double nearest_m = 0.02;
constexpr double farthest_m = 500.0;
constexpr double per_step = 0.88;  // the distance left after one step of the wheel

glm::dquat rotation_of(const RoomCamera& camera) {
  return glm::angleAxis(glm::radians(-camera.azimuth_deg), glm::dvec3(0.0, 1.0, 0.0)) *
         glm::angleAxis(glm::radians(-camera.elevation_deg), glm::dvec3(1.0, 0.0, 0.0));
}

/// The corner number 0..7 of a box.
glm::dvec3 corner(const Bounds& bounds, unsigned number) {
  return {(number & 1u) != 0 ? bounds.max_m.x : bounds.min_m.x, (number & 2u) != 0 ? bounds.max_m.y : bounds.min_m.y,
          (number & 4u) != 0 ? bounds.max_m.z : bounds.min_m.z};
}

}  // namespace

std::optional<StandardView> standard_view_named(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, StandardView>, 6> names{{{"front", StandardView::front},
                                                                            {"back", StandardView::back},
                                                                            {"left", StandardView::left},
                                                                            {"right", StandardView::right},
                                                                            {"top", StandardView::top},
                                                                            {"bottom", StandardView::bottom}}};
  for (const auto& [word, side] : names) {
    if (word == name) return side;
  }
  return std::nullopt;
}

RoomView view_of(const RoomCamera& camera, const glm::dvec2& size_px) {
  RoomView view;
  view.world_from_camera.rotation = rotation_of(camera);
  view.world_from_camera.position_m =
      camera.target_m + view.world_from_camera.rotation * glm::dvec3(0.0, 0.0, camera.distance_m);
  view.size_px = size_px;
  view.focal_px = glm::dvec2(0.5 * std::min(size_px.x, size_px.y) / std::tan(glm::radians(half_fov_deg)));
  view.centre_px = 0.5 * size_px;
  view.near_m = std::clamp(0.02 * camera.distance_m, 0.002, 0.1);
  view.far_m = 60.0 + 20.0 * camera.distance_m;
  return view;
}

RoomCamera orbited(const RoomCamera& camera, const glm::dvec2& moved_px, double per_px_deg) {
  RoomCamera turned = camera;
  turned.azimuth_deg = std::remainder(camera.azimuth_deg + per_px_deg * moved_px.x, 360.0);
  turned.elevation_deg = std::clamp(camera.elevation_deg + per_px_deg * moved_px.y, -90.0, 90.0);
  return turned;
}

RoomCamera panned(const RoomCamera& camera, const glm::dvec2& size_px, const glm::dvec2& moved_px) {
  const RoomView view = view_of(camera, size_px);
  const glm::dvec2 moved_m = moved_px / view.focal_px * camera.distance_m;
  RoomCamera moved = camera;
  moved.target_m -= view.world_from_camera.direction({moved_m.x, -moved_m.y, 0.0});
  return moved;
}

RoomCamera zoomed(const RoomCamera& camera, const glm::dvec2& size_px, const glm::dvec2& pixel, double steps) {
  const RoomView view = view_of(camera, size_px);
  const glm::dvec2 from_axis_m = (pixel - view.centre_px) / view.focal_px * camera.distance_m;
  const glm::dvec3 under_m = camera.target_m + view.world_from_camera.direction({from_axis_m.x, -from_axis_m.y, 0.0});
  RoomCamera nearer = camera;
  nearer.distance_m = std::clamp(camera.distance_m * std::pow(per_step, steps), nearest_m, farthest_m);
  const double left = nearer.distance_m / camera.distance_m;
  nearer.target_m = under_m + left * (camera.target_m - under_m);
  return nearer;
}

RoomCamera fitted(const RoomCamera& camera, const glm::dvec2& size_px, const Bounds& bounds) {
  if (bounds.empty()) return camera;
  RoomCamera fit = camera;
  fit.target_m = 0.5 * (bounds.min_m + bounds.max_m);
  const RoomView view = view_of(camera, size_px);
  const glm::dquat camera_from_world = glm::conjugate(view.world_from_camera.rotation);
  const glm::dvec2 half_tangent = 0.45 * size_px / view.focal_px;
  double distance_m = nearest_m;
  for (unsigned i = 0; i < 8; ++i) {
    const glm::dvec3 p = camera_from_world * (corner(bounds, i) - fit.target_m);
    distance_m = std::max({distance_m, p.z + std::abs(p.x) / half_tangent.x, p.z + std::abs(p.y) / half_tangent.y});
  }
  fit.distance_m = std::clamp(distance_m, 5.0 * nearest_m, farthest_m);
  return fit;
}

RoomCamera from_side(const RoomCamera& camera, StandardView side) {
  RoomCamera seen = camera;
  seen.elevation_deg = 0.0;
  switch (side) {
    case StandardView::front:
      seen.azimuth_deg = 0.0;
      break;
    case StandardView::back:
      seen.azimuth_deg = 180.0;
      break;
    case StandardView::left:
      seen.azimuth_deg = 90.0;  // from the left, looking to the right
      break;
    case StandardView::right:
      seen.azimuth_deg = -90.0;
      break;
    case StandardView::top:
      seen.azimuth_deg = 0.0;
      seen.elevation_deg = 90.0;
      break;
    case StandardView::bottom:
      seen.azimuth_deg = 0.0;
      seen.elevation_deg = -90.0;
      break;
  }
  return seen;
}

}  // namespace focalstage
