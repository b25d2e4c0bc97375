#include "core/scene/edit.h"

#include <algorithm>

#include "core/scene/fields_project.h"
#include "core/scene/project_value.h"
#include "core/scene/set_value.h"

// Every edit goes through the value of what it changes, so that the field tables alone say what may stand there.
namespace focalstage {
namespace {

/// "objects/near/depth/mode"
std::string place_of(const Edit& edit) {
  std::string place = edit.list.empty() ? "project" : edit.list;
  if (!edit.name.empty()) place = pointer_into(place, edit.name);
  if (!edit.key.empty()) place += "/" + edit.key;
  return place;
}

Fault fault_at(const Edit& edit, std::string code, std::string message, std::string remedy) {
  return {std::move(code), place_of(edit), std::move(message), std::move(remedy)};
}

/// The fault of a reader, told as the edit's: what the reader met lies at or below the edit's key.
Fault told_as(const Edit& edit, const Fault& read) {
  Edit item = edit;
  item.key.clear();
  return {"edit.value", place_of(item) + read.where, read.message + " (" + read.code + ")", read.remedy};
}

/// True if setting made a key that nobody knows: a slip of the pen rather than a newer version's key.
bool made_unknown(const Edit& edit, const Value& before, const std::vector<Finding>& notes) {
  const std::string set = "/" + edit.key;
  return std::any_of(notes.begin(), notes.end(), [&](const Finding& note) {
    const bool on_the_way = (set + "/").starts_with(note.where + "/");
    return on_the_way && !value_at(before, pointer_steps(note.where));
  });
}

/// `thing` with the edit's key set.
template <class Thing>
Result<Thing> with_key_set(const Thing& thing, const Edit& edit) {
  const Value before = Codec<Thing>::write(thing);
  Value after = before;
  if (const Status set = set_value(after, edit.key, edit.value); !set) {
    return fault_at(edit, set.fault().code, set.fault().message, set.fault().remedy);
  }
  std::vector<Finding> notes;
  Reading reading(&notes);
  Thing changed;
  if (!Codec<Thing>::read(reading, after, changed, {})) return told_as(edit, *reading.fault());
  if (made_unknown(edit, before, notes)) {
    return fault_at(edit, "edit.key", "there is no such key", "name a key that the project's schema lists");
  }
  return changed;
}

/// The whole project with a key set, by the path from its root.
Result<Project> with_root_key_set(const Project& project, const Edit& edit) {
  const Value before = value_from(project);
  Value after = before;
  if (const Status set = set_value(after, edit.key, edit.value); !set) {
    return fault_at(edit, set.fault().code, set.fault().message, set.fault().remedy);
  }
  std::vector<Finding> notes;
  auto changed = project_from(after, &notes);
  if (!changed) return told_as(edit, changed.fault());
  if (made_unknown(edit, before, notes)) {
    return fault_at(edit, "edit.key", "there is no such key", "name a key that the project's schema lists");
  }
  return changed;
}

template <class Item>
auto find_item(std::vector<Item>& items, const std::string& name) {
  return std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.name == name; });
}

template <class Item>
Status add(std::vector<Item>& items, const Edit& edit) {
  Value value = edit.value;
  if (value.object() && !edit.name.empty()) {
    const Value* own = value.find("name");
    if (own && *own != Value(edit.name)) {
      return fault_at(edit, "edit.name", "the item to add has another name", "use the same name in both places");
    }
    value.set("name", Value(edit.name));
  }
  Reading reading(nullptr);
  Item item;
  if (!Codec<Item>::read(reading, value, item, {})) return told_as(edit, *reading.fault());
  if (find_item(items, item.name) != items.end()) {
    return fault_at(edit, "edit.name", "\"" + item.name + "\" is there already", "choose another name");
  }
  const auto before = find_item(items, edit.key);
  if (!edit.key.empty() && before == items.end()) {
    return fault_at(edit, "edit.key", "there is no item \"" + edit.key + "\" to stand before",
                    "name an item of the list, or leave the key out");
  }
  items.insert(before, std::move(item));
  return {};
}

template <class Item>
Status rename(std::vector<Item>& items, Item& item, const Edit& edit) {
  Reading reading(nullptr);
  std::string name;
  if (!Codec<std::string>::read(reading, edit.value, name, a_name)) return told_as(edit, *reading.fault());
  if (name != item.name && find_item(items, name) != items.end()) {
    return fault_at(edit, "edit.name", "\"" + name + "\" is there already", "choose another name");
  }
  item.name = std::move(name);
  return {};
}

template <class Item>
Status move(std::vector<Item>& items, Item& item, const Edit& edit) {
  Reading reading(nullptr);
  int place = 0;
  const Rule places{.low = 0.0, .high = static_cast<double>(items.size()) - 1.0};
  if (!Codec<int>::read(reading, edit.value, place, places)) return told_as(edit, *reading.fault());
  const auto from = items.begin() + (&item - items.data());
  const auto to = items.begin() + place;
  if (from < to) {
    std::rotate(from, from + 1, to + 1);
  } else {
    std::rotate(to, from, from + 1);
  }
  return {};
}

template <class Item>
Status group(Item& item, const Edit& edit) {
  if constexpr (requires { item.group; }) {
    Reading reading(nullptr);
    if (!Codec<std::string>::read(reading, edit.value, item.group, {})) return told_as(edit, *reading.fault());
    return {};
  } else {
    return fault_at(edit, "edit.list", "the items of this list have no groups", "group surfaces or objects");
  }
}

template <class Item>
Status set(Item& item, const Edit& edit) {
  if (edit.key == "name") {
    return fault_at(edit, "edit.key", "a name is not set like another key", "use a rename edit");
  }
  auto changed = with_key_set(item, edit);
  if (!changed) return changed.fault();
  item = std::move(*changed);
  return {};
}

template <class Item>
Status edit_list(std::vector<Item>& items, const Edit& edit) {
  if (edit.kind == Edit::Kind::add) return add(items, edit);
  const auto item = find_item(items, edit.name);
  if (item == items.end()) {
    return fault_at(edit, "edit.name", "there is no \"" + edit.name + "\" in " + edit.list, "name an item of the list");
  }
  switch (edit.kind) {
    case Edit::Kind::set:
      return set(*item, edit);
    case Edit::Kind::rename:
      return rename(items, *item, edit);
    case Edit::Kind::move:
      return move(items, *item, edit);
    case Edit::Kind::group:
      return group(*item, edit);
    case Edit::Kind::add:
    case Edit::Kind::remove:
      break;
  }
  items.erase(item);
  return {};
}

template <class Part>
Status edit_part(Part& part, const Edit& edit) {
  if (edit.kind != Edit::Kind::set || !edit.name.empty()) {
    return fault_at(edit, "edit.kind", "there is one \"" + edit.list + "\", without a name", "use set, with a key");
  }
  auto changed = with_key_set(part, edit);
  if (!changed) return changed.fault();
  part = std::move(*changed);
  return {};
}

Status edit_root(Project& project, const Edit& edit) {
  if (edit.kind != Edit::Kind::set || !edit.name.empty()) {
    return fault_at(edit, "edit.kind", "the project itself can only be set", "name a list, or use set with a key");
  }
  auto changed = with_root_key_set(project, edit);
  if (!changed) return changed.fault();
  project = std::move(*changed);
  return {};
}

Status edit_project(Project& project, const Edit& edit) {
  if (edit.list.empty()) return edit_root(project, edit);
  if (edit.list == "viewer") return edit_part(project.viewer, edit);
  if (edit.list == "glasses") return edit_part(project.glasses, edit);
  if (edit.list == "sweep") return edit_part(project.sweep, edit);
  if (edit.list == "slices") return edit_part(project.slices, edit);
  if (edit.list == "frames") return edit_part(project.frames, edit);
  if (edit.list == "projectors") return edit_list(project.projectors, edit);
  if (edit.list == "surfaces") return edit_list(project.surfaces, edit);
  if (edit.list == "objects") return edit_list(project.objects, edit);
  if (edit.list == "lights") return edit_list(project.lights, edit);
  if (edit.list == "cues") return edit_list(project.cues, edit);
  return fault_at(edit, "edit.list", "a project has no \"" + edit.list + "\"",
                  "use viewer, glasses, sweep, projectors, slices, frames, surfaces, objects, lights, cues or \"\"");
}

std::optional<Fault> between_parts(const Project& project) {
  Reading reading(nullptr);
  check_project(reading, project);
  return reading.fault();
}

}  // namespace

Result<Project> apply(const Project& project, const Edit& edit) {
  Project changed = project;
  if (const Status done = edit_project(changed, edit); !done) return done.fault();
  name_lights(changed.lights);
  // What was amiss before is not this edit's doing, and must not keep it from being mended step by step.
  const auto amiss = between_parts(changed);
  if (amiss && amiss != between_parts(project)) {
    return fault_at(edit, "edit.value", amiss->where + " " + amiss->message + " (" + amiss->code + ")", amiss->remedy);
  }
  return changed;
}

Result<Project> apply_all(const Project& project, const std::vector<Edit>& edits) {
  Result<Project> changed = project;
  for (const Edit& edit : edits) {
    changed = apply(*changed, edit);
    if (!changed) return changed;
  }
  return changed;
}

}  // namespace focalstage
