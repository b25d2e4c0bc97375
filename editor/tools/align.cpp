#include "editor/tools/align.h"

#include <glm/geometric.hpp>

namespace focalstage {
namespace {

double end_m(const Aligned& item, int axis, AlignTo to) {
  if (item.bounds.empty()) return item.thing.pose.position_m[axis];
  switch (to) {
    case AlignTo::low:
      return item.bounds.min_m[axis];
    case AlignTo::high:
      return item.bounds.max_m[axis];
    case AlignTo::middle:
      break;
  }
  return 0.5 * (item.bounds.min_m[axis] + item.bounds.max_m[axis]);
}

}  // namespace

std::vector<HandleThing> aligned(const std::vector<Aligned>& things, std::size_t axis, AlignTo to) {
  std::vector<HandleThing> moved;
  const int a = static_cast<int>(axis);
  for (const Aligned& item : things) {
    moved.push_back(item.thing);
    moved.back().pose.position_m[a] += end_m(things.back(), a, to) - end_m(item, a, to);
  }
  return moved;
}

std::vector<HandleThing> at_same_distance(const std::vector<HandleThing>& things, const Rigid& world_from_viewer) {
  std::vector<HandleThing> moved = things;
  if (things.empty()) return moved;
  const double distance_m = glm::length(things.back().pose.position_m - world_from_viewer.position_m);
  for (HandleThing& thing : moved) {
    if (thing == things.back()) continue;  // to the last bit where it was
    thing.pose.position_m =
        world_from_viewer.position_m + distance_m * sight_to(world_from_viewer, thing.pose.position_m);
  }
  return moved;
}

}  // namespace focalstage
