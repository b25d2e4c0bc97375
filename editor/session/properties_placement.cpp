// Where things stand, how large they are, how they move and what they are called.
#include <array>

#include "core/base/number_words.h"
#include "editor/session/angles.h"
#include "editor/session/edits.h"
#include "editor/session/property_rows.h"
#include "editor/tools/pose_edits.h"

namespace focalstage {
namespace {

constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};
constexpr std::array<const char*, 3> angle_names{"pitch", "yaw", "roll"};

glm::dvec3::length_type axis_of(const Property& row) { return row.key.back() - '0'; }

std::vector<Edit> set_position(const PropertyScope& scope, const Thing& thing, const Property& row,
                               const Value& value) {
  const auto from = handle_thing(scope.project, thing.list, thing.name, scope.time_s);
  if (!from || !value.number()) return {};
  HandleThing to = *from;
  to.pose.position_m[axis_of(row)] = *value.number();
  return pose_edits(scope.project, *from, to, scope.time_s);
}

std::vector<Edit> set_angle(const PropertyScope& scope, const Thing& thing, const Property& row, const Value& value) {
  const auto from = handle_thing(scope.project, thing.list, thing.name, scope.time_s);
  if (!from || !value.number()) return {};
  glm::dvec3 angles_deg = angles_of(from->pose.rotation, scope.angles_near_deg);
  angles_deg[axis_of(row)] = *value.number();
  HandleThing to = *from;
  to.pose.rotation = rotation_of(angles_deg);
  return pose_edits(scope.project, *from, to, scope.time_s);
}

std::vector<Edit> set_name(const PropertyScope&, const Thing& thing, const Property&, const Value& value) {
  return {{Edit::Kind::rename, thing.list, thing.name, "", value}};
}

std::vector<Edit> set_group(const PropertyScope&, const Thing& thing, const Property&, const Value& value) {
  return {{Edit::Kind::group, thing.list, thing.name, "", value}};
}

bool is_locked(const PropertyRows& rows) {
  const bool* locked = rows.at("locked").boolean();
  return locked && *locked;
}

void lock_if(Property& row, bool locked) {
  if (locked) row.unavailable = "It is locked. Unlock it to change this.";
}

bool has_keys(const PropertyRows& rows) {
  const Value::Array* keys = rows.at("keys").array();
  return keys && !keys->empty();
}

}  // namespace

void add_pose_rows(PropertyRows& rows) {
  const Thing& thing = rows.thing();
  const auto handle = handle_thing(rows.scope().project, thing.list, thing.name, rows.scope().time_s);
  if (!handle) return;
  const std::string keyed = has_keys(rows) ? "It moves: this sets its key at the frame in view." : "";
  const auto add = [&](const char* what, const char* label, int axis, double value) -> Property& {
    Property& row = rows.add(Property::Kind::number, label, Value(value));
    row.id = std::string(what) + " " + label;
    row.help = keyed;
    row.key = (row.id[0] == 'p' ? "position_m/" : "rotation/") + std::to_string(axis);
    lock_if(row, is_locked(rows));
    return row;
  };
  const KeyFacts anywhere = key_facts<Keyframe>("position_m");
  rows.group("Position");
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    Property& row = add("position", axis_names[i], axis, handle->pose.position_m[axis]);
    row.unit = "m";
    row.step = 0.001;
    row.least = anywhere.least;
    row.most = anywhere.most;
    row.edits = set_position;
  }
  if (!handle->turns) return;
  const glm::dvec3 angles_deg = angles_of(handle->pose.rotation, rows.scope().angles_near_deg);
  rows.group("Rotation");
  for (int axis = 0; axis < 3; ++axis) {
    Property& row = add("rotation", angle_names[static_cast<std::size_t>(axis)], axis, angles_deg[axis]);
    row.unit = "°";
    row.digits = 1;
    row.step = 0.5;
    row.least = -36000.0;
    row.most = 36000.0;
    row.edits = set_angle;
  }
}

void add_size_rows(PropertyRows& rows) {
  rows.group("Size");
  Property& scale = rows.number<Object>("scale", "scale", {"", 3, 0.002});
  scale.help = "Times as large as the mesh says.";
  lock_if(scale, is_locked(rows));
  const std::vector<Drawable>* drawables = drawables_of(rows.scope(), rows.thing());
  const Bounds bounds = drawables ? world_bounds(*drawables) : Bounds{};
  if (bounds.empty()) return;
  const glm::dvec3 size_cm = 100.0 * bounds.size_m();
  std::string text;
  for (int axis = 0; axis < 3; ++axis) text += (axis > 0 ? " × " : "") + fixed_text(size_cm[axis], 1);
  rows.shown("extent", text + " cm").help = "Width, height and depth of the box around it in the room.";
}

void add_movement_rows(PropertyRows& rows) {
  rows.group("Movement");
  Property& track = rows.text("follows", "track");
  track.help = "The name of a tracked body that it moves with. Empty: it stands, or moves by its keys.";
  const Value::Array* keys = rows.at("keys").array();
  Property& row = rows.shown("keys", keys && !keys->empty() ? std::to_string(keys->size()) : "none");
  row.key = "keys";
  row.removable = keys && !keys->empty();
  row.help = row.removable ? "Set and moved on the timeline. Without them it stands where it stood before it had any."
                           : "K sets one: it stands here at this moment.";
}

void add_name_row(PropertyRows& rows) {
  Property& name = rows.text("name", "name");
  name.edits = set_name;
  name.help = "Its own in its list. Edits, tracks and cues know it by this name.";
}

void add_listed_rows(PropertyRows& rows) {
  rows.group("In the project");
  add_name_row(rows);
  Property& group = rows.text("group", "group");
  group.edits = set_group;
  group.help = "Things of one group stand together in the outline. Empty: in none.";
  rows.flag("hidden", "hidden").help = "What is hidden is neither drawn nor compiled.";
  rows.flag("locked", "locked").help = "What is locked cannot be picked, moved or deleted.";
}

}  // namespace focalstage
