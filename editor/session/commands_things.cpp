#include <array>
#include <utility>

#include "editor/session/command_list.h"
#include "editor/session/edits.h"
#include "editor/session/new_mesh.h"

namespace focalstage {
namespace {

constexpr glm::dquat upright(1.0, 0.0, 0.0, 0.0);

/// Before the viewer, at arm's length: where a new thing is seen at once.
glm::dvec3 before_viewer(const Session& session, double distance_m) {
  const Rigid viewer = pose_of(session.project(), {"viewer", ""}, 0.0);
  return viewer.point({0.0, 0.0, -distance_m});
}

/// args: kind; name, position_m if not before the viewer
Status add_object(Session& session, const Value& args) {
  const auto kind = text_arg(args, "kind");
  if (!kind) return kind.fault();
  const auto mesh = new_mesh(*kind, false);
  if (!mesh) return mesh.fault();
  const std::string name = free_name(session.project(), "objects", text_or(args, "name", *kind));
  const bool one_metre = is_metre_high(*kind);
  Value item;
  item.set("mesh", *mesh);
  const Value* position = args.find("position_m");
  glm::dvec3 place = before_viewer(session, 0.45);
  if (one_metre) place.y -= 0.05;
  item.set("position_m", position ? *position : value_of(place));
  item.set("rotation_xyzw", value_of(upright));
  item.set("scale", one_metre ? 0.1 : 1.0);
  item.set("depth", Value(Value::Object{{"mode", "placed"}}));
  Status done = session.edit("Add " + name, {add_edit("objects", name, item)});
  if (done) session.select({{"objects", name}});
  return done;
}

/// args: kind; name
Status add_surface(Session& session, const Value& args) {
  const std::string kind = text_or(args, "kind", "plane");
  const auto mesh = new_mesh(kind, true);
  if (!mesh) return mesh.fault();
  const std::string name =
      free_name(session.project(), "surfaces", text_or(args, "name", kind == "plane" ? "screen" : kind));
  Value item;
  item.set("mesh", *mesh);
  item.set("position_m", value_of(before_viewer(session, 0.6)));
  item.set("rotation_xyzw", value_of(upright));
  item.set("illumination", 0.0);
  Status done = session.edit("Add " + name, {add_edit("surfaces", name, item)});
  if (done) session.select({{"surfaces", name}});
  return done;
}

template <int Kind>
Status add_primitive(Session& session, const Value& args) {
  static constexpr std::array<const char*, 7> kinds{"plane", "box", "sphere", "rabbit", "teapot", "corner", "step"};
  Value with_kind = args;
  with_kind.set("kind", kinds[Kind]);
  return add_object(session, with_kind);
}

/// args: kind: sun, point or sky
Status add_light(Session& session, const Value& args) {
  const std::string kind = text_or(args, "kind", "sun");
  const std::string name = free_name(session.project(), "lights", kind);
  Value item;
  item.set("kind", kind);
  if (kind == "sun") item.set("direction", value_of(glm::dvec3(-0.4, -0.6, -0.7)));
  if (kind == "point") item.set("position_m", value_of(before_viewer(session, 0.3)));
  item.set("color", value_of(glm::dvec3(1.0)));
  item.set("intensity", kind == "sky" ? 0.2 : 0.6);
  Status done = session.edit("Add " + name, {add_edit("lights", name, item)});
  if (done) session.select({{"lights", name}});
  return done;
}

/// args: power_d
Status add_slice(Session& session, const Value& args) {
  std::vector<double> powers = session.project().slices.powers_d;
  const double highest_d = powers.empty() ? -0.5 : powers.back();
  powers.push_back(number_or(args, "power_d", highest_d + 0.5));
  Value::Array array;
  for (const double power_d : powers) array.emplace_back(power_d);
  return session.edit("Add a slice", {set_edit({"slices", ""}, "powers_d", Value(std::move(array)))});
}

/// args: index
Status remove_slice(Session& session, const Value& args) {
  const auto index = number_arg(args, "index");
  if (!index) return index.fault();
  std::vector<double> powers = session.project().slices.powers_d;
  if (*index < 0 || *index >= static_cast<double>(powers.size()) || powers.size() < 2) {
    return Fault{"command.argument", "index", "this slice cannot be removed", "keep at least one"};
  }
  Value::Array array;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    if (i != static_cast<std::size_t>(*index)) array.emplace_back(powers[i]);
  }
  return session.edit("Remove a slice", {set_edit({"slices", ""}, "powers_d", Value(std::move(array)))});
}

/// args: index, power_d; dragging: the hand is still moving
Status set_slice(Session& session, const Value& args) {
  const auto index = number_arg(args, "index"), power_d = number_arg(args, "power_d");
  if (!index || !power_d) return index ? power_d.fault() : index.fault();
  Value::Array array;
  for (const double known_d : session.project().slices.powers_d) array.emplace_back(known_d);
  if (*index < 0 || *index >= static_cast<double>(array.size())) {
    return Fault{"command.argument", "index", "there is no such slice", ""};
  }
  array[static_cast<std::size_t>(*index)] = *power_d;
  std::vector<Edit> edits{set_edit({"slices", ""}, "powers_d", Value(std::move(array)))};
  return flag_or(args, "dragging", false) ? session.drag("Set a slice's power", std::move(edits))
                                          : session.edit("Set a slice's power", std::move(edits));
}

}  // namespace

void add_things_commands(CommandList& list) {
  const auto add = [&](Command command) { list.push_back(command); };
  add({"add.surface", "Add a surface", "", "A real plane to project on", "surface", true, needs_project, add_surface});
  add({"add.object", "Add an object", "", "A virtual object of a kind", "object", false, needs_project, add_object});
  add({"add.rabbit", "Add a rabbit", "", "A virtual rabbit before the viewer", "object", true, needs_project,
       add_primitive<3>});
  add({"add.teapot", "Add a teapot", "", "A virtual teapot before the viewer", "object", true, needs_project,
       add_primitive<4>});
  add({"add.box", "Add a box", "", "A virtual box before the viewer", "object", true, needs_project, add_primitive<1>});
  add({"add.sphere", "Add a sphere", "", "A virtual sphere before the viewer", "object", true, needs_project,
       add_primitive<2>});
  add({"add.plane", "Add a plane", "", "A virtual plane before the viewer", "object", true, needs_project,
       add_primitive<0>});
  add({"add.corner", "Add a corner", "", "Two virtual wings that meet", "object", true, needs_project,
       add_primitive<5>});
  add({"add.step", "Add a step", "", "A virtual step", "object", true, needs_project, add_primitive<6>});
  add({"add.light", "Add a light", "", "A sun; point and sky by their kind", "light", true, needs_project, add_light});
  add({"add.slice", "Add a slice", "", "One more power of the sweep", "slice", true, needs_project, add_slice});
  add({"slice.remove", "Remove a slice", "", "", "", false, needs_project, remove_slice});
  add({"slice.set", "Set a slice's power", "", "", "", false, needs_project, set_slice});
}

}  // namespace focalstage
