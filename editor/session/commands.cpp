#include <algorithm>

#include "editor/session/command_list.h"

namespace focalstage {
namespace {

bool is_thing(const Thing& thing) { return thing.list == "objects" || thing.list == "surfaces"; }

Fault argument_fault(std::string_view key, const char* kind) {
  return {"command.argument", std::string(key), std::string("needs ") + kind, ""};
}

}  // namespace

std::span<const Command> commands() {
  static const CommandList list = [] {
    CommandList made;
    add_file_commands(made);
    add_export_commands(made);
    add_edit_commands(made);
    add_things_commands(made);
    add_place_commands(made);
    add_time_commands(made);
    add_sweep_commands(made);
    add_view_commands(made);
    add_steer_commands(made);
    add_eye_commands(made);
    add_rig_commands(made);
    add_finding_commands(made);
    add_solve_commands(made);
    return made;
  }();
  return list;
}

const Command* command_named(std::string_view id) {
  const auto all = commands();
  const auto at = std::find_if(all.begin(), all.end(), [&](const Command& command) { return command.id == id; });
  return at == all.end() ? nullptr : &*at;
}

std::string always(const Session&) { return {}; }
std::string needs_project(const Session& session) { return session.has_document() ? "" : "open a project first"; }

std::string needs_selection(const Session& session) {
  if (!session.has_document()) return needs_project(session);
  return session.selection().empty() ? "select something first" : "";
}

std::string needs_things(const Session& session) {
  if (!session.has_document()) return needs_project(session);
  const auto& things = session.selection().things;
  return std::any_of(things.begin(), things.end(), is_thing) ? "" : "select a surface or an object first";
}

Result<std::string> text_arg(const Value& args, std::string_view key) {
  const Value* value = args.find(key);
  if (!value || !value->text()) return argument_fault(key, "a text");
  return *value->text();
}

Result<double> number_arg(const Value& args, std::string_view key) {
  const Value* value = args.find(key);
  if (!value || !value->number()) return argument_fault(key, "a number");
  return *value->number();
}

std::string text_or(const Value& args, std::string_view key, std::string otherwise) {
  const auto text = text_arg(args, key);
  return text ? *text : std::move(otherwise);
}

double number_or(const Value& args, std::string_view key, double otherwise) {
  const auto number = number_arg(args, key);
  return number ? *number : otherwise;
}

bool flag_or(const Value& args, std::string_view key, bool otherwise) {
  const Value* value = args.find(key);
  return value && value->boolean() ? *value->boolean() : otherwise;
}

std::string words_for(const std::string& verb, const std::vector<Thing>& things) {
  if (things.size() == 1) return verb + " " + title_of(things[0]);
  return verb + " " + std::to_string(things.size()) + " things";
}

std::vector<Thing> unlocked(const Session::State& state) {
  std::vector<Thing> things;
  for (const Thing& thing : state.selection.things) {
    const Object* object = thing.list == "objects" ? object_named(state.project(), thing.name) : nullptr;
    const Surface* surface = thing.list == "surfaces" ? surface_named(state.project(), thing.name) : nullptr;
    if ((object && !object->locked) || (surface && !surface->locked)) things.push_back(thing);
  }
  return things;
}

}  // namespace focalstage
