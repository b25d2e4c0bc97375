#include "editor/session/properties.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "editor/session/edits.h"
#include "editor/session/property_rows.h"

namespace focalstage {
namespace {

template <class Items>
Value written(const Items& items, const std::string& name) {
  using Item = typename Items::value_type;
  const auto at = std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.name == name; });
  return at == items.end() ? Value() : Codec<Item>::write(*at);
}

struct KindOfThing {
  const char* list;
  void (*rows)(PropertyRows&);
  Value (*item)(const Project&, const std::string& name);
};

constexpr std::array<KindOfThing, 10> kinds{{
    {"surfaces", add_surface_rows, [](const Project& p, const std::string& name) { return written(p.surfaces, name); }},
    {"objects", add_object_rows, [](const Project& p, const std::string& name) { return written(p.objects, name); }},
    {"lights", add_light_rows, [](const Project& p, const std::string& name) { return written(p.lights, name); }},
    {"projectors", add_projector_rows,
     [](const Project& p, const std::string& name) { return written(p.projectors, name); }},
    {"viewer", add_viewer_rows, [](const Project& p, const std::string&) { return Codec<Viewer>::write(p.viewer); }},
    {"glasses", add_glasses_rows,
     [](const Project& p, const std::string&) { return Codec<Glasses>::write(p.glasses); }},
    {"sweep", add_sweep_rows, [](const Project& p, const std::string&) { return Codec<Sweep>::write(p.sweep); }},
    {"slices", add_slices_rows, [](const Project& p, const std::string&) { return Codec<Slices>::write(p.slices); }},
    {"frames", add_frames_rows, [](const Project& p, const std::string&) { return Codec<Frames>::write(p.frames); }},
    {"", add_project_rows,
     [](const Project& p, const std::string&) {
       Value item;
       item.set("name", p.name);
       item.set("ambient_lux", p.ambient_lux);
       return item;
     }},
}};

std::vector<PropertyGroup> rows_of(const PropertyScope& scope, const Thing& thing) {
  for (const KindOfThing& kind : kinds) {
    if (thing.list != kind.list) continue;
    const Value item = kind.item(scope.project, thing.name);
    if (item.is_null()) return {};
    PropertyRows rows(scope, thing, item);
    kind.rows(rows);
    return rows.take();
  }
  return {};
}

/// Numbers that differ by rounding alone are the same to a person.
bool same(const Value& a, const Value& b) {
  if (!a.number() || !b.number()) return a == b;
  return std::abs(*a.number() - *b.number()) <= 1e-9 * std::max(1.0, std::abs(*a.number()));
}

/// What can be said of, and done to, several things at once.
bool is_common(const Property& row) {
  if (row.kind == Property::Kind::shown && row.mixed) return row.removable;
  return row.kind != Property::Kind::action && row.key != "name";
}

bool same_row(const Property& a, const Property& b) {
  return a.id == b.id && a.kind == b.kind && a.key == b.key && a.edits == b.edits && a.unit == b.unit;
}

void join(Property& row, const Property& another) {
  if (!same(row.value, another.value)) row.mixed = true;
  if (row.other != another.other) row.other.clear();
  if (row.unavailable.empty()) row.unavailable = another.unavailable;
  row.removable = row.removable || another.removable;
}

/// Keeps of `groups` the rows that `others` have too.
void meet(std::vector<PropertyGroup>& groups, const std::vector<PropertyGroup>& others) {
  std::map<std::string_view, const Property*> known;
  for (const PropertyGroup& group : others) {
    for (const Property& row : group.rows) known[row.id] = &row;
  }
  for (PropertyGroup& group : groups) {
    std::erase_if(group.rows, [&](Property& row) {
      const auto at = known.find(row.id);
      if (at == known.end() || !same_row(row, *at->second)) return true;
      join(row, *at->second);
      return false;
    });
  }
}

std::string count_text(const std::vector<Thing>& things) {
  static constexpr std::array<std::array<const char*, 3>, 4> words{{{"surfaces", "surface", "surfaces"},
                                                                    {"objects", "object", "objects"},
                                                                    {"lights", "light", "lights"},
                                                                    {"projectors", "projector", "projectors"}}};
  std::string text;
  std::size_t named = 0;
  const auto add = [&](std::size_t count, const char* word) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + word;
  };
  for (const auto& [list, one, many] : words) {
    const auto count = static_cast<std::size_t>(
        std::count_if(things.begin(), things.end(), [&](const Thing& thing) { return thing.list == list; }));
    add(count, count == 1 ? one : many);
    named += count;
  }
  add(things.size() - named, text.empty() ? "things" : "more");
  return text;
}

std::string mesh_text(const MeshSource& mesh) {
  if (const auto* file = std::get_if<FileMesh>(&mesh.shape))
    return std::filesystem::path(file->file).filename().string();
  const Value written = Codec<MeshSource>::write(mesh);
  const Value* primitive = written.find("primitive");
  return primitive && primitive->text() ? *primitive->text() : "";
}

std::string subtitle_of(const PropertyScope& scope, const Thing& thing) {
  const Project& project = scope.project;
  const Object* object = thing.list == "objects" ? object_named(project, thing.name) : nullptr;
  const Surface* surface = thing.list == "surfaces" ? surface_named(project, thing.name) : nullptr;
  if (object || surface) {
    const std::string mesh = mesh_text(object ? object->mesh : surface->mesh);
    if (object ? object->hidden : surface->hidden) return mesh + ", hidden";
    const std::vector<Drawable>* drawables = drawables_of(scope, thing);
    return drawables ? mesh + ", " + grouped_text(triangles_of(*drawables)) + " triangles" : mesh;
  }
  for (const Projector& projector : project.projectors) {
    if (thing == Thing{"projectors", projector.name}) {
      return projector.model + ", " + std::to_string(projector.width_px) + " × " + std::to_string(projector.height_px);
    }
  }
  if (thing.list == "lights") return "light";
  if (thing.list == "viewer") return "who looks";
  if (thing.list == "glasses") return "lenses and shutters";
  if (thing.list == "sweep") return "how the lenses' power goes round";
  if (thing.list == "slices") return grouped_text(project.slices.powers_d.size()) + " powers";
  if (thing.list == "frames") return "the show in time";
  return "Select something to change it";
}

}  // namespace

std::vector<PropertyGroup> properties_of(const PropertyScope& scope, const std::vector<Thing>& things) {
  if (things.empty()) return rows_of(scope, {});
  // Measuring depths takes a search through meshes: for one thing at a time.
  PropertyScope each = scope;
  if (things.size() > 1) each.picker = nullptr;
  std::vector<PropertyGroup> groups = rows_of(each, things.back());
  for (std::size_t i = 0; i + 1 < things.size() && !groups.empty(); ++i) meet(groups, rows_of(each, things[i]));
  if (things.size() > 1) {
    for (PropertyGroup& group : groups) std::erase_if(group.rows, [](const Property& row) { return !is_common(row); });
  }
  std::erase_if(groups, [](const PropertyGroup& group) { return group.rows.empty(); });
  return groups;
}

std::vector<Edit> edits_for(const PropertyScope& scope, const std::vector<Thing>& things, const Property& row,
                            const Value& value) {
  if (row.kind == Property::Kind::action || (row.kind == Property::Kind::shown && !row.removable)) return {};
  if (!row.unavailable.empty() || (value.is_null() && !row.removable)) return {};
  Value wanted = value;
  if (row.kind == Property::Kind::integer && value.number()) wanted = Value(std::round(*value.number()));
  if (!row.mixed && wanted == row.value) return {};
  static const std::vector<Thing> project_itself{Thing{}};
  std::vector<Edit> edits;
  for (const Thing& thing : things.empty() ? project_itself : things) {
    if (!row.edits) {
      edits.push_back(set_edit(thing, row.key, wanted));
      continue;
    }
    for (Edit& edit : row.edits(scope, thing, row, wanted)) edits.push_back(std::move(edit));
  }
  return edits;
}

std::string words_for(const Property& row, const std::vector<Thing>& things, const Value& value) {
  const std::string whom = things.empty()       ? "the project"
                           : things.size() == 1 ? title_of(things[0])
                                                : std::to_string(things.size()) + " things";
  if (value.is_null()) return "Remove " + row.label + " of " + whom;
  if (row.key.starts_with("position_m")) return "Move " + whom;
  if (row.key.starts_with("rotation")) return "Turn " + whom;
  if (row.key == "scale") return "Scale " + whom;
  if (row.key == "name") return "Rename " + whom;
  return "Set " + row.label + " of " + whom;
}

PropertyTitle title_for(const PropertyScope& scope, const std::vector<Thing>& things) {
  if (things.size() > 1) return {std::to_string(things.size()) + " things", count_text(things)};
  const Thing thing = things.empty() ? Thing{} : things[0];
  const std::string& name = scope.project.name;
  return {things.empty() && !name.empty() ? name : title_of(thing), subtitle_of(scope, thing)};
}

const Property* row_named(const std::vector<PropertyGroup>& groups, std::string_view id) {
  for (const PropertyGroup& group : groups) {
    for (const Property& row : group.rows) {
      if (row.id == id) return &row;
    }
  }
  return nullptr;
}

}  // namespace focalstage
