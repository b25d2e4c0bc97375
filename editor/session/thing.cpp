#include "editor/session/thing.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "core/scene/pointer.h"

namespace focalstage {
namespace {

/// The single things of a project, by the key that edits call their list, and what people call them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> singles{{
    {"viewer", "Viewer"},
    {"glasses", "Glasses"},
    {"sweep", "Sweep"},
    {"slices", "Slices"},
    {"frames", "Frames"},
}};

template <class Items>
void add_all(std::vector<Thing>& things, const char* list, const Items& items) {
  for (const auto& item : items) things.push_back({list, item.name});
}

template <class Items>
const auto* named(const Items& items, const std::string& name) {
  const auto at = std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
  return at == items.end() ? nullptr : &*at;
}

template <class Items>
std::string name_at(const Items& items, const std::string& step) {
  const auto index = index_in(step);
  return index && *index < items.size() ? items[*index].name : std::string();
}

}  // namespace

std::vector<Thing> things_of(const Project& project) {
  std::vector<Thing> things;
  add_all(things, "surfaces", project.surfaces);
  add_all(things, "objects", project.objects);
  add_all(things, "lights", project.lights);
  add_all(things, "projectors", project.projectors);
  for (const auto& [list, title] : singles) things.push_back({std::string(list), ""});
  return things;
}

bool exists(const Project& project, const Thing& thing) {
  const std::vector<Thing> things = things_of(project);
  return std::find(things.begin(), things.end(), thing) != things.end();
}

bool stands_in_room(const Thing& thing) {
  return thing.list == "surfaces" || thing.list == "objects" || thing.list == "projectors" || thing.list == "viewer" ||
         thing.list == "lights";
}

const Object* object_named(const Project& project, const std::string& name) { return named(project.objects, name); }
const Surface* surface_named(const Project& project, const std::string& name) { return named(project.surfaces, name); }

std::string title_of(const Thing& thing) {
  if (!thing.name.empty()) return thing.name;
  for (const auto& [list, title] : singles) {
    if (thing.list == list) return std::string(title);
  }
  return "Project";
}

std::string free_name(const Project& project, const std::string& list, const std::string& wanted) {
  std::string name = wanted;
  for (int k = 2; exists(project, {list, name}); ++k) name = wanted + " " + std::to_string(k);
  return name;
}

Thing thing_at(const Project& project, const std::string& pointer) {
  const std::vector<std::string> steps = pointer_steps(pointer);
  if (steps.empty()) return {};
  const std::string& list = steps[0];
  for (const auto& [single, title] : singles) {
    if (list == single) return {list, ""};
  }
  if (steps.size() < 2) return {};
  std::string name;
  if (list == "surfaces") name = name_at(project.surfaces, steps[1]);
  if (list == "objects") name = name_at(project.objects, steps[1]);
  if (list == "lights") name = name_at(project.lights, steps[1]);
  if (list == "projectors") name = name_at(project.projectors, steps[1]);
  return name.empty() ? Thing{} : Thing{list, name};
}

}  // namespace focalstage
