#include "editor/tools/handle_frame.h"

#include <glm/geometric.hpp>

namespace focalstage {
namespace {

constexpr double same_place_m = 1e-9;

/// Right and up as the viewer has them, square to `sight`; straight above or below, the viewer's own right holds.
std::array<glm::dvec3, 3> sight_axes(const Rigid& world_from_viewer, const glm::dvec3& sight) {
  const glm::dvec3 up = world_from_viewer.direction({0.0, 1.0, 0.0});
  glm::dvec3 right = glm::cross(sight, up);
  if (glm::length(right) < 1e-6) right = world_from_viewer.direction({1.0, 0.0, 0.0});
  right = glm::normalize(right);
  return {right, glm::cross(right, sight), sight};
}

}  // namespace

glm::dvec3 sight_to(const Rigid& world_from_viewer, const glm::dvec3& point_m) {
  const glm::dvec3 way = point_m - world_from_viewer.position_m;
  const double distance_m = glm::length(way);
  return distance_m > same_place_m ? way / distance_m : world_from_viewer.direction({0.0, 0.0, -1.0});
}

HandleFrame handle_frame(HandleSpace space, const std::vector<HandleThing>& things, const Rigid& world_from_viewer) {
  HandleFrame frame;
  frame.space = space;
  for (const HandleThing& thing : things) frame.origin_m += thing.pose.position_m / static_cast<double>(things.size());
  switch (space) {
    case HandleSpace::world:
      frame.coordinates_m = frame.origin_m;
      break;
    case HandleSpace::local:
      for (std::size_t i = 0; i < 3; ++i) frame.axes[i] = things.back().pose.direction(frame.axes[i]);
      break;
    case HandleSpace::sight:
      frame.axes = sight_axes(world_from_viewer, sight_to(world_from_viewer, frame.origin_m));
      frame.coordinates_m.z = glm::length(frame.origin_m - world_from_viewer.position_m);
      break;
  }
  return frame;
}

}  // namespace focalstage
