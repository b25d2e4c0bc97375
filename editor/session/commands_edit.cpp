#include <algorithm>
#include <utility>

#include "editor/session/command_list.h"
#include "editor/session/edits.h"

namespace focalstage {
namespace {

std::string needs_undo(const Session& session) {
  return session.has_document() && session.document().history().can_undo() ? "" : "nothing to undo";
}
std::string needs_redo(const Session& session) {
  return session.has_document() && session.document().history().can_redo() ? "" : "nothing to redo";
}
std::string needs_clipboard(const Session& session) {
  if (!session.has_document()) return needs_project(session);
  return SessionAccess::of(session).clipboard.array() ? "" : "copy something first";
}

Status go_to(Session& session, std::size_t place) {
  session.end_drag();
  auto& state = SessionAccess::of(session);
  Status done = state.document->jump(place);
  state.tidy();
  state.restage();
  state.wish_preview();
  return done;
}

Status undo(Session& session, const Value&) { return go_to(session, session.document().history().place() - 1); }
Status redo(Session& session, const Value&) { return go_to(session, session.document().history().place() + 1); }

/// args: place, a number of steps from the beginning
Status jump(Session& session, const Value& args) {
  const auto place = number_arg(args, "place");
  if (!place || *place < 0) return Fault{"command.argument", "place", "needs a number of steps", ""};
  return go_to(session, static_cast<std::size_t>(*place));
}

/// What a project can do without, of what is selected.
std::vector<Thing> removable(const Session::State& state) {
  std::vector<Thing> things = unlocked(state);
  for (const Thing& thing : state.selection.things) {
    if (thing.list == "lights" || (thing.list == "projectors" && state.project().projectors.size() > 1)) {
      things.push_back(thing);
    }
  }
  return things;
}

Status remove(Session& session, const Value&) {
  auto& state = SessionAccess::of(session);
  if (state.view.key_time_s) {
    Value args;
    args.set("time_s", *state.view.key_time_s);
    return session.run("key.delete", args);
  }
  const std::vector<Thing> things = removable(state);
  if (things.empty()) {
    return Fault{"session.locked", "", "nothing selected can be deleted", "unlock it first, or keep one projector"};
  }
  std::vector<Edit> edits;
  for (const Thing& thing : things) edits.push_back({Edit::Kind::remove, thing.list, thing.name, "", {}});
  return session.edit(words_for("Delete", things), std::move(edits));
}

/// Names that the items of one paste get, each free also beside the others.
std::string next_name(const Project& project, const std::vector<Edit>& edits, const std::string& list,
                      const std::string& wanted) {
  const auto taken = [&](const std::string& name) {
    return exists(project, {list, name}) ||
           std::any_of(edits.begin(), edits.end(), [&](const Edit& e) { return e.list == list && e.name == name; });
  };
  std::string name = wanted;
  for (int k = 2; taken(name); ++k) name = wanted + " " + std::to_string(k);
  return name;
}

/// Adds copied items under free names and selects them.
Status add_items(Session& session, const std::string& words, const Value::Array& items) {
  auto& state = SessionAccess::of(session);
  std::vector<Edit> edits;
  std::vector<Thing> added;
  for (const Value& copied : items) {
    const auto list = text_arg(copied, "list"), name = text_arg(copied, "name");
    const Value* item = copied.find("item");
    if (!list || !name || !item) continue;
    Value fresh = *item;
    const std::string free = next_name(state.project(), edits, *list, *name);
    fresh.set("name", free);
    edits.push_back(add_edit(*list, free, std::move(fresh)));
    added.push_back({*list, free});
  }
  if (Status done = session.edit(words, std::move(edits)); !done) return done;
  session.select(added);
  return {};
}

Value::Array copied_selection(const Session::State& state) {
  Value::Array items;
  for (const Thing& thing : state.selection.things) {
    const Value item = item_of(state.project(), thing);
    if (item.is_null() || thing.name.empty()) continue;
    Value copied;
    copied.set("list", thing.list);
    copied.set("name", thing.name);
    copied.set("item", item);
    items.push_back(std::move(copied));
  }
  return items;
}

Status copy(Session& session, const Value&) {
  auto& state = SessionAccess::of(session);
  Value::Array items = copied_selection(state);
  if (items.empty()) return Fault{"session.nothing", "", "this cannot be copied", "select surfaces, objects or lights"};
  state.clipboard_folder = state.document->folder();
  state.clipboard = Value(std::move(items));
  return {};
}

Status cut(Session& session, const Value& args) {
  if (Status copied = copy(session, args); !copied) return copied;
  return remove(session, args);
}

/// Meshes that come with things of another project are brought into this one first.
Result<Value::Array> with_their_files(const Session::State& state, Value::Array items) {
  if (state.clipboard_folder == state.document->folder()) return items;
  for (Value& copied : items) {
    Value* item = copied.find("item");
    Value* mesh = item ? item->find("mesh") : nullptr;
    const Value* file = mesh ? mesh->find("file") : nullptr;
    if (!file || !file->text()) continue;
    const auto brought = bring_in(state.clipboard_folder / *file->text(), state.document->folder());
    if (!brought) return brought.fault();
    mesh->set("file", *brought);
  }
  return items;
}

Status paste(Session& session, const Value&) {
  auto& state = SessionAccess::of(session);
  const auto items = with_their_files(state, *state.clipboard.array());
  if (!items) return items.fault();
  return add_items(session, "Paste " + std::to_string(items->size()), *items);
}

Status duplicate(Session& session, const Value&) {
  const auto& state = SessionAccess::of(session);
  const Value::Array items = copied_selection(state);
  if (items.empty()) return Fault{"session.nothing", "", "this cannot be duplicated", ""};
  return add_items(session, words_for("Duplicate", state.selection.things), items);
}

/// Sets `key` of all selected surfaces and objects.
Status set_all(Session& session, const std::string& verb, const std::vector<Thing>& things, const std::string& key,
               const Value& value) {
  std::vector<Edit> edits;
  for (const Thing& thing : things) edits.push_back(set_edit(thing, key, value));
  return session.edit(words_for(verb, things), std::move(edits));
}

std::vector<Thing> selected_things(const Session& session) {
  std::vector<Thing> things;
  for (const Thing& thing : session.selection().things) {
    if (thing.list == "objects" || thing.list == "surfaces") things.push_back(thing);
  }
  return things;
}

bool flag_of(const Project& project, const Thing& thing, bool Object::*of_object, bool Surface::*of_surface) {
  if (const Object* object = thing.list == "objects" ? object_named(project, thing.name) : nullptr) {
    return object->*of_object;
  }
  const Surface* surface = surface_named(project, thing.name);
  return surface && surface->*of_surface;
}

/// All on, unless all are on already.
Status toggle_all(Session& session, const char* on, const char* off, const std::string& key, bool Object::*of_object,
                  bool Surface::*of_surface) {
  const std::vector<Thing> things = selected_things(session);
  const bool all = std::all_of(things.begin(), things.end(), [&](const Thing& thing) {
    return flag_of(session.project(), thing, of_object, of_surface);
  });
  return set_all(session, all ? off : on, things, key, Value(!all));
}

Status hide(Session& session, const Value&) {
  return toggle_all(session, "Hide", "Show", "hidden", &Object::hidden, &Surface::hidden);
}
Status lock(Session& session, const Value&) {
  return toggle_all(session, "Lock", "Unlock", "locked", &Object::locked, &Surface::locked);
}

Status show_all(Session& session, const Value&) {
  std::vector<Thing> hidden;
  for (const Thing& thing : things_of(session.project())) {
    if ((thing.list == "objects" || thing.list == "surfaces") &&
        flag_of(session.project(), thing, &Object::hidden, &Surface::hidden)) {
      hidden.push_back(thing);
    }
  }
  return hidden.empty() ? Status{} : set_all(session, "Show", hidden, "hidden", Value(false));
}

/// args: name; none or "": out of their groups
Status group(Session& session, const Value& args) {
  const std::vector<Thing> things = selected_things(session);
  std::string name = text_or(args, "name", "");
  if (!args.find("name")) name = "group " + std::to_string(things.size());
  std::vector<Edit> edits;
  for (const Thing& thing : things) edits.push_back({Edit::Kind::group, thing.list, thing.name, "", Value(name)});
  return session.edit(words_for(name.empty() ? "Ungroup" : "Group", things), std::move(edits));
}

Status ungroup(Session& session, const Value&) {
  Value args;
  args.set("name", "");
  return group(session, args);
}

/// args: name, the new one (none: it is typed in the outline); list and of, the thing (none: the selected one)
Status rename(Session& session, const Value& args) {
  const Thing* selected = session.selection().primary();
  if (!args.find("name")) {
    if (!selected || selected->name.empty()) {
      return Fault{"session.nothing", "", "nothing selected has a name of its own", "select a thing of a list"};
    }
    session.view().renaming = *selected;
    return {};
  }
  const auto name = text_arg(args, "name");
  if (!name) return name.fault();
  const Thing thing{text_or(args, "list", selected ? selected->list : ""),
                    text_or(args, "of", selected ? selected->name : "")};
  if (thing.name == *name) return {};
  Status done = session.edit("Rename " + thing.name + " to " + *name,
                             {{Edit::Kind::rename, thing.list, thing.name, "", Value(*name)}});
  if (done) session.select({{thing.list, *name}});
  return done;
}

/// args: list, name; add: keeps what is selected
Status select(Session& session, const Value& args) {
  const auto list = text_arg(args, "list");
  if (!list) return list.fault();
  const Thing thing{*list, text_or(args, "name", "")};
  if (!exists(session.project(), thing)) return Fault{"command.argument", thing.name, "there is no such thing", ""};
  Selection next = flag_or(args, "add", false) ? session.selection() : Selection{};
  next.toggle(thing);
  session.select(next.things);
  return {};
}

Status select_all(Session& session, const Value&) {
  std::vector<Thing> things = things_of(session.project());
  std::erase_if(things, [](const Thing& thing) { return thing.list != "objects" && thing.list != "surfaces"; });
  session.select(std::move(things));
  return {};
}

Status select_none(Session& session, const Value&) {
  session.select({});
  return {};
}

}  // namespace

void add_edit_commands(CommandList& list) {
  const auto add = [&](Command command) { list.push_back(command); };
  add({"edit.undo", "Undo", "Ctrl+Z", "Take back the last step", "undo", true, needs_undo, undo});
  add({"edit.redo", "Redo", "Ctrl+Shift+Z", "Do again what was taken back", "redo", true, needs_redo, redo});
  add({"edit.jump", "Go to a step", "", "Anywhere in the history", "", false, needs_project, jump});
  add({"edit.cut", "Cut", "Ctrl+X", "Copy and delete what is selected", "", true, needs_selection, cut});
  add({"edit.copy", "Copy", "Ctrl+C", "Copy what is selected, also for another project", "", true, needs_selection,
       copy});
  add({"edit.paste", "Paste", "Ctrl+V", "Add what was copied, with its files", "", true, needs_clipboard, paste});
  add({"edit.duplicate", "Duplicate", "Ctrl+D", "A second one of each selected thing", "duplicate", true,
       needs_selection, duplicate});
  add({"edit.delete", "Delete", "Delete", "Remove what is selected", "delete", true, needs_selection, remove});
  add({"edit.rename", "Rename", "F2", "Give the selected thing another name", "rename", true, needs_selection, rename});
  add({"edit.hide", "Hide or show", "H", "What is hidden is neither drawn nor compiled", "hidden", true, needs_things,
       hide});
  add({"edit.show-all", "Show all", "Alt+H", "Bring back everything hidden", "visible", true, needs_project, show_all});
  add({"edit.lock", "Lock or unlock", "L", "What is locked cannot be picked, moved or deleted", "locked", true,
       needs_things, lock});
  add({"edit.group", "Group", "Ctrl+G", "Put the selected things into one group", "group", true, needs_things, group});
  add({"edit.ungroup", "Ungroup", "Ctrl+Shift+G", "Take the selected things out of their groups", "", true,
       needs_things, ungroup});
  add({"select", "Select", "", "Select a thing by its list and name", "", false, needs_project, select});
  add({"select.all", "Select all", "Ctrl+A", "All surfaces and objects", "", true, needs_project, select_all});
  add({"select.none", "Select nothing", "Escape", "Nothing is selected", "", true, needs_project, select_none});
}

}  // namespace focalstage
