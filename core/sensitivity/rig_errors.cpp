#include "core/sensitivity/rig_errors.h"

#include <glm/gtc/quaternion.hpp>

#include "core/mesh/circle.h"

namespace focalstage {
namespace {

constexpr const char* axes[3] = {"x", "y", "z"};

/// Along or about one of a pose's own axes, by millimetres or degrees.
struct Move {
  int axis = 0;
  bool turn = false;
  double amount = 0.0;
};

Rigid moved(const Rigid& pose, const Move& move) {
  glm::dvec3 along(0.0);
  along[move.axis] = 1.0;
  if (!move.turn) return {pose.position_m + pose.direction(along * (1e-3 * move.amount)), pose.rotation};
  const SinCos half = sin_cos_deg(0.5 * move.amount);
  return {pose.position_m, pose.rotation * glm::dquat(half.cos, along * half.sin)};
}

void put_off(Placement& placement, const Move& move) {
  placement.pose = moved(placement.pose, move);
  for (Keyframe& key : placement.keys) key.pose = moved(key.pose, move);
}

/// Six of one thing, whose pose `change` changes.
template <class Change>
void add_pose(const std::string& name, const Change& change, std::vector<RigError>& errors) {
  for (const bool turn : {false, true}) {
    for (int axis = 0; axis < 3; ++axis) {
      errors.push_back({name + (turn ? " turned about " : " along ") + axes[axis], 1.0, turn ? "°" : "mm",
                        [=](Project& project, double amount) {
                          change(project, {axis, turn, amount});
                        }});
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
      "viewer", [](Project& p, const Move& move) { put_off(p.viewer.placement, move); }, errors);
  for (std::size_t i = 0; i < project.surfaces.size(); ++i) {
    if (project.surfaces[i].hidden) continue;
    const auto change = [i](Project& p, const Move& move) { put_off(p.surfaces[i].placement, move); };
    add_pose(project.surfaces[i].name, change, errors);
  }
  for (std::size_t i = 0; i < project.objects.size(); ++i) {
    if (project.objects[i].hidden || project.objects[i].placement.track.empty()) continue;
    const auto change = [i](Project& p, const Move& move) { put_off(p.objects[i].placement, move); };
    add_pose(project.objects[i].name, change, errors);
  }
  if (!project.projectors.empty()) {
    const auto change = [](Project& p, const Move& move) { p.projectors[0].pose = moved(p.projectors[0].pose, move); };
    add_pose(project.projectors[0].name, change, errors);
  }
  const auto nothing = [](Project&, double) {};
  errors.push_back({"lens power", 0.1, "D", nothing, 1.0});
  errors.push_back(
      {"lens to pupil", 1.0, "mm", [](Project& p, double amount) { p.glasses.lens_to_pupil_mm += amount; }});
  errors.push_back(
      {"interpupillary distance", 1.0, "mm", [](Project& p, double amount) { p.viewer.interpupillary_mm += amount; }});
  if (anything_moves(project)) errors.push_back({"light late", 1.0, "ms", nothing, 0.0, 1e-3});
  return errors;
}

RealRig real_rig(const Project& project, const ErrorAmounts& amounts) {
  RealRig real{project};
  for (const RigError& error : rig_errors(project)) {
    const auto asked = amounts.find(error.what);
    if (asked == amounts.end()) continue;
    error.make(real.project, asked->second);
    real.power_d += error.power_d * asked->second;
    real.late_s += error.late_s * asked->second;
  }
  return real;
}

}  // namespace focalstage
