#include "editor/tools/pose_edits.h"

#include <algorithm>
#include <cmath>

#include "core/stage/stage.h"

namespace focalstage {
namespace {

constexpr double same_time_s = 1e-6;

template <class List>
auto named(const List& list, const std::string& name) -> decltype(list.data()) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& item) { return item.name == name; });
  return found == list.end() ? nullptr : &*found;
}

const Placement* placement_of(const Project& project, const HandleThing& thing) {
  if (thing.list == "viewer") return &project.viewer.placement;
  if (thing.list == "surfaces") {
    const Surface* surface = named(project.surfaces, thing.name);
    return surface == nullptr ? nullptr : &surface->placement;
  }
  if (thing.list == "objects") {
    const Object* object = named(project.objects, thing.name);
    return object == nullptr ? nullptr : &object->placement;
  }
  return nullptr;
}

Value value_of(const glm::dvec3& v) { return Value::Array{Value(v.x), Value(v.y), Value(v.z)}; }
Value value_of(const glm::dquat& q) { return Value::Array{Value(q.x), Value(q.y), Value(q.z), Value(q.w)}; }

Value value_of(const Keyframe& key) {
  Value value;
  value.set("time_s", key.time_s);
  value.set("position_m", value_of(key.pose.position_m));
  value.set("rotation_xyzw", value_of(key.pose.rotation));
  for (const auto& [member, unknown] : key.unknown) value.set(member, unknown);
  return value;
}

Edit set(const HandleThing& thing, std::string key, Value value) {
  return {Edit::Kind::set, thing.list, thing.name, std::move(key), std::move(value)};
}

/// All keys again: a drag that puts a new key must set the same edit key at its first and its last move.
Edit keys_edit(const Placement& placement, const HandleThing& to, double time_s) {
  std::vector<Keyframe> keys = placement.keys;
  const auto after =
      std::find_if(keys.begin(), keys.end(), [&](const Keyframe& key) { return key.time_s >= time_s - same_time_s; });
  if (after != keys.end() && std::abs(after->time_s - time_s) <= same_time_s) {
    after->pose = to.pose;
  } else {
    keys.insert(after, Keyframe{time_s, to.pose});
  }
  Value::Array values;
  for (const Keyframe& key : keys) values.push_back(value_of(key));
  return set(to, "keys", std::move(values));
}

/// Which keys an edit sets.
struct Touched {
  bool position;
  bool rotation;
  bool scale;
};

std::vector<Edit> edits_of(const Project& project, const HandleThing& to, const Touched& touched, double time_s) {
  std::vector<Edit> edits;
  const Placement* placement = placement_of(project, to);
  if (placement != nullptr && !placement->keys.empty()) {
    if (touched.position || (touched.rotation && to.turns)) edits.push_back(keys_edit(*placement, to, time_s));
  } else {
    if (touched.position) edits.push_back(set(to, "position_m", value_of(to.pose.position_m)));
    if (touched.rotation && to.turns) edits.push_back(set(to, "rotation_xyzw", value_of(to.pose.rotation)));
  }
  if (touched.scale && to.scales) edits.push_back(set(to, "scale", Value(to.scale)));
  return edits;
}

}  // namespace

std::optional<HandleThing> handle_thing(const Project& project, const std::string& list, const std::string& name,
                                        double time_s) {
  if (list == "viewer") return HandleThing{list, name, pose_at(project.viewer.placement, time_s), 1.0, true, false};
  if (list == "surfaces") {
    const Surface* surface = named(project.surfaces, name);
    if (surface != nullptr) return HandleThing{list, name, pose_at(surface->placement, time_s), surface->scale};
  } else if (list == "objects") {
    const Object* object = named(project.objects, name);
    if (object != nullptr) return HandleThing{list, name, pose_at(object->placement, time_s), object->scale};
  } else if (list == "projectors") {
    const Projector* projector = named(project.projectors, name);
    if (projector != nullptr) return HandleThing{list, name, projector->pose, 1.0, true, false};
  } else if (list == "lights") {
    const Light* light = named(project.lights, name);
    if (light != nullptr && light->kind == LightKind::point) {
      return HandleThing{list, name, Rigid{light->position_m}, 1.0, false, false};
    }
  }
  return std::nullopt;
}

std::vector<Edit> pose_edits(const Project& project, const HandleThing& from, const HandleThing& to, double time_s) {
  return edits_of(
      project, to,
      {from.pose.position_m != to.pose.position_m, from.pose.rotation != to.pose.rotation, from.scale != to.scale},
      time_s);
}

std::vector<Edit> drag_edits(const Project& project, HandleTool tool, const std::vector<HandleThing>& from,
                             const std::vector<HandleThing>& to, bool with_size, double time_s) {
  std::vector<Edit> edits;
  for (std::size_t i = 0; i < from.size() && i < to.size(); ++i) {
    const Touched touched{tool == HandleTool::move || from.size() > 1, tool == HandleTool::turn,
                          tool == HandleTool::scale || (tool == HandleTool::move && with_size)};
    for (Edit& edit : edits_of(project, to[i], touched, time_s)) edits.push_back(std::move(edit));
  }
  return edits;
}

}  // namespace focalstage
