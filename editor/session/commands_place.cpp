// Where selected things stand, by command: aligned, dropped, looked at.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "editor/session/command_list.h"
#include "editor/session/edits.h"
#include "editor/tools/align.h"
#include "editor/tools/drop.h"
#include "editor/tools/pick.h"
#include "editor/tools/pose_edits.h"

namespace focalstage {
namespace {

std::string needs_several(const Session& session) {
  if (std::string why = needs_things(session); !why.empty()) return why;
  return session.selection().things.size() > 1 ? "" : "select two things or more";
}

const std::vector<Drawable>* drawables_of(const Stage& stage, const Thing& thing) {
  for (const StagedObject& object : stage.objects) {
    if (thing == Thing{"objects", object.name}) return &object.drawables;
  }
  for (const StagedSurface& surface : stage.surfaces) {
    if (thing == Thing{"surfaces", surface.name}) return &surface.drawables;
  }
  return nullptr;
}

std::vector<HandleThing> handled(const Session::State& state) {
  std::vector<HandleThing> things;
  for (const Thing& thing : unlocked(state)) {
    if (const auto found = handle_thing(state.project(), thing.list, thing.name, state.frame_time_s())) {
      things.push_back(*found);
    }
  }
  return things;
}

Status place(Session& session, const std::string& words, const std::vector<HandleThing>& from,
             const std::vector<HandleThing>& to) {
  const auto& state = SessionAccess::of(session);
  std::vector<Edit> edits;
  for (std::size_t i = 0; i < from.size(); ++i) {
    for (Edit& edit : pose_edits(state.project(), from[i], to[i], state.frame_time_s()))
      edits.push_back(std::move(edit));
  }
  return session.edit(words, std::move(edits));
}

/// args: axis: x, y or z; to: low, middle or high
Status align(Session& session, const Value& args) {
  const auto& state = SessionAccess::of(session);
  const std::string axis = text_or(args, "axis", "y"), to = text_or(args, "to", "low");
  constexpr std::string_view axes = "xyz";
  if (axis.size() != 1 || axes.find(axis) == std::string_view::npos) {
    return Fault{"command.argument", "axis", "is x, y or z", ""};
  }
  const AlignTo end = to == "high" ? AlignTo::high : to == "middle" ? AlignTo::middle : AlignTo::low;
  const std::vector<HandleThing> from = handled(state);
  std::vector<Aligned> things;
  for (const HandleThing& thing : from) {
    const auto* drawables = drawables_of(*state.stage, {thing.list, thing.name});
    things.push_back({thing, drawables ? world_bounds(*drawables) : Bounds{}});
  }
  return place(session, "Align " + std::to_string(from.size()) + " things", from,
               aligned(things, axes.find(axis), end));
}

Status same_distance(Session& session, const Value&) {
  const auto& state = SessionAccess::of(session);
  const std::vector<HandleThing> from = handled(state);
  return place(session, "Put " + std::to_string(from.size()) + " things at one distance", from,
               at_same_distance(from, state.stage->world_from_viewer));
}

/// args: way: down, or sight: away from the viewer
Status drop(Session& session, const Value& args) {
  const auto& state = SessionAccess::of(session);
  const std::vector<HandleThing> from = handled(state);
  std::vector<HandleThing> to = from;
  Picker picker;
  const auto others = [&](const StagedName& name) { return !session.selection().has({name.list, name.name}); };
  bool any = false;
  for (HandleThing& thing : to) {
    const auto* drawables = drawables_of(*state.stage, {thing.list, thing.name});
    if (!drawables) continue;
    const bool along_sight = text_or(args, "way", "down") == "sight";
    const glm::dvec3 way =
        along_sight ? sight_to(state.stage->world_from_viewer, thing.pose.position_m) : glm::dvec3(0.0, -1.0, 0.0);
    const auto free_m = drop_m(*state.stage, *drawables, way, picker, others);
    if (!free_m) continue;
    thing.pose.position_m += *free_m * way;
    any = true;
  }
  if (!any) return Fault{"session.no-surface", "", "nothing lies in the way", "add a surface below or behind it"};
  return place(session, words_for("Drop", session.selection().things), from, to);
}

Status drop_along_sight(Session& session, const Value&) {
  Value args;
  args.set("way", "sight");
  return drop(session, args);
}

Status zoom(Session& session, const Value&) {
  auto& state = SessionAccess::of(session);
  const auto wanted = [&](const StagedName& name) { return session.selection().has({name.list, name.name}); };
  const Bounds bounds = stage_bounds(*state.stage, wanted);
  if (bounds.empty())
    return Fault{"session.nothing", "", "this has no shape to look at", "select a surface or an object"};
  state.view.look_through = LookThrough::nothing;
  state.view.camera = fitted(state.view.camera, {640.0, 480.0}, bounds);
  return {};
}

}  // namespace

void add_place_commands(CommandList& list) {
  const auto add = [&](Command command) { list.push_back(command); };
  add({"view.zoom-selection", "Look at the selection", "F", "The room's camera goes to what is selected", "zoom-fit",
       true, needs_things, zoom});
  add({"edit.align", "Align", "", "The lower ends of all selected things level with the last one's", "align", true,
       needs_several, align});
  add({"edit.same-distance", "Put at one distance", "", "All as far from the viewer as the last, along their sight",
       "depth", true, needs_several, same_distance});
  add({"edit.drop", "Drop to surface", "D", "Down, until it rests on something", "down", true, needs_things, drop});
  add({"edit.drop-along-sight", "Drop along the sight", "Shift+D", "Away from the viewer, until it touches a surface",
       "", true, needs_things, drop_along_sight});
}

}  // namespace focalstage
