#include "core/sensitivity/rig_errors.h"

#include <glm/gtc/quaternion.hpp>

#include "core/mesh/circle.h"

namespace focalstage {
namespace {

constexpr const char* axes[3] = {"x", "y", "z"};

/// By so much along or about one of its own axes.
Rigid moved(const Rigid& pose, int axis, bool turn) {
  glm::dvec3 along(0.0);
  along[axis] = 1.0;
  if (!turn) return {pose.position_m + pose.direction(along * 1e-3), pose.rotation};
  const SinCos half = sin_cos_deg(0.5);
  return {pose.position_m, pose.rotation * glm::dquat(half.cos, along * half.sin)};
}

void move(Placement& placement, int axis, bool turn) {
  placement.pose = moved(placement.pose, axis, turn);
  for (Keyframe& key : placement.keys) key.pose = moved(key.pose, axis, turn);
}

/// Six of one thing, whose pose `change` changes.
template <class Change>
void add_pose(const std::string& name, const Change& change, std::vector<RigError>& errors) {
  for (const bool turn : {false, true}) {
    for (int axis = 0; axis < 3; ++axis) {
      errors.push_back({name + (turn ? " turned about " : " along ") + axes[axis], 1.0, turn ? "°" : "mm",
                        [=](Project& project) { change(project, axis, turn); }});
    }
  }
}

bool moves(const Placement& placement) { return !placement.keys.empty() || !placement.track.empty(); }

bool anything_moves(const Project& project) {
  bool any = moves(project.viewer.placement);
  for (const Surface& surface : project.surfaces) any = any || moves(surface.placement);
  for (const Object& object : project.objects) any = any || moves(object.placement);
  return any;
}

}  // namespace

std::vector<RigError> rig_errors(const Project& project) {
  std::vector<RigError> errors;
  add_pose(
      "viewer", [](Project& p, int axis, bool turn) { move(p.viewer.placement, axis, turn); }, errors);
  for (std::size_t i = 0; i < project.surfaces.size(); ++i) {
    if (project.surfaces[i].hidden) continue;
    const auto change = [i](Project& p, int axis, bool turn) { move(p.surfaces[i].placement, axis, turn); };
    add_pose(project.surfaces[i].name, change, errors);
  }
  for (std::size_t i = 0; i < project.objects.size(); ++i) {
    if (project.objects[i].hidden || project.objects[i].placement.track.empty()) continue;
    const auto change = [i](Project& p, int axis, bool turn) { move(p.objects[i].placement, axis, turn); };
    add_pose(project.objects[i].name, change, errors);
  }
  if (!project.projectors.empty()) {
    const auto change = [](Project& p, int axis, bool turn) {
      p.projectors[0].pose = moved(p.projectors[0].pose, axis, turn);
    };
    add_pose(project.projectors[0].name, change, errors);
  }
  const auto nothing = [](Project&) {};
  errors.push_back({"lens power", 0.1, "D", nothing, 0.1});
  errors.push_back({"lens to pupil", 1.0, "mm", [](Project& p) { p.glasses.lens_to_pupil_mm += 1.0; }});
  errors.push_back({"interpupillary distance", 1.0, "mm", [](Project& p) { p.viewer.interpupillary_mm += 1.0; }});
  if (anything_moves(project)) errors.push_back({"light late", 1.0, "ms", nothing, 0.0, 1e-3});
  return errors;
}

}  // namespace focalstage
