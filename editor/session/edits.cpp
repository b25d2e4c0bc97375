#include "editor/session/edits.h"

#include <algorithm>

#include "core/scene/project_value.h"
#include "core/stage/stage.h"

namespace focalstage {
namespace {

Value key_value(const Keyframe& key) {
  Value value;
  value.set("time_s", key.time_s);
  value.set("position_m", value_of(key.pose.position_m));
  value.set("rotation_xyzw", value_of(key.pose.rotation));
  for (const auto& [name, kept] : key.unknown) value.set(name, kept);
  return value;
}

}  // namespace

Value value_of(const glm::dvec3& v) { return Value(Value::Array{v.x, v.y, v.z}); }
Value value_of(const glm::dquat& q) { return Value(Value::Array{q.x, q.y, q.z, q.w}); }

Edit set_edit(const Thing& thing, std::string key, Value value) {
  return {Edit::Kind::set, thing.list, thing.name, std::move(key), std::move(value)};
}

Edit add_edit(const std::string& list, const std::string& name, Value item) {
  return {Edit::Kind::add, list, name, "", std::move(item)};
}

const Placement* placement_of(const Project& project, const Thing* thing) {
  if (!thing) return nullptr;
  if (thing->list == "viewer") return &project.viewer.placement;
  const Object* object = thing->list == "objects" ? object_named(project, thing->name) : nullptr;
  const Surface* surface = thing->list == "surfaces" ? surface_named(project, thing->name) : nullptr;
  return object ? &object->placement : surface ? &surface->placement : nullptr;
}

bool has_key_at(const Project& project, const Thing* thing, double time_s) {
  const Placement* placement = placement_of(project, thing);
  if (!placement) return false;
  return std::any_of(placement->keys.begin(), placement->keys.end(),
                     [&](const Keyframe& key) { return same_key(key.time_s, time_s); });
}

Value keys_value(const std::vector<Keyframe>& keys) {
  Value::Array array;
  for (const Keyframe& key : keys) array.push_back(key_value(key));
  return Value(std::move(array));
}

Rigid pose_of(const Project& project, const Thing& thing, double time_s) {
  if (const Placement* placement = placement_of(project, &thing)) return pose_at(*placement, time_s);
  for (const Projector& projector : project.projectors) {
    if (thing == Thing{"projectors", projector.name}) return projector.pose;
  }
  for (const Light& light : project.lights) {
    if (thing == Thing{"lights", light.name}) return {light.position_m, {1.0, 0.0, 0.0, 0.0}};
  }
  return {};
}

Value item_of(const Project& project, const Thing& thing) {
  const Value whole = value_from(project);
  const Value* list = whole.find(thing.list);
  if (!list) return {};
  if (!list->array()) return *list;
  for (const Value& item : *list->array()) {
    const Value* name = item.find("name");
    if (name && *name == Value(thing.name)) return item;
  }
  return {};
}

}  // namespace focalstage
