#include "editor/session/outline_rows.h"

#include <algorithm>
#include <array>
#include <optional>

namespace focalstage {
namespace {

struct Section {
  const char* list;  ///< its first; of the last section, that of none
  const char* label;
  const char* icon;  ///< of its things
};

constexpr std::array<Section, 4> sections{{{"surfaces", "Surfaces", "surface"},
                                           {"objects", "Objects", "object"},
                                           {"lights", "Lights", "light"},
                                           {"projectors", "Projectors", "projectors"}}};
constexpr std::array<Section, 5> rig{{{"viewer", "Viewer", "viewer"},
                                      {"glasses", "Glasses", "glasses"},
                                      {"sweep", "Sweep", "loop"},
                                      {"slices", "Slices", "slices"},
                                      {"frames", "Frames", "frames"}}};

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool holds(std::string_view text, std::string_view part) {
  const auto same = [](char a, char b) { return lower(a) == lower(b); };
  return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

/// Builds the rows of one section, group by group.
class SectionRows {
 public:
  SectionRows(std::vector<OutlineRow>& rows, const std::set<std::string>& folded, std::string_view filter)
      : rows_(rows), folded_(folded), filter_(filter) {}

  template <class Items>
  void add(const Section& section, const Items& items) {
    begin(section.list, section.label);
    for (std::size_t i = 0; i < items.size(); ++i) {
      const std::string& group = group_of(items[i]);
      if (group.empty()) {
        put(thing_row(section, items[i]));
      } else if (filter_.empty() && first_of(items, group) == i) {
        add_group(section, items, group);
      } else if (!filter_.empty()) {
        put(thing_row(section, items[i]));
      }
    }
    end();
  }

  void add_rig() {
    begin("", "Viewer & rig");
    for (const Section& part : rig) {
      OutlineRow row;
      row.thing = {part.list, ""};
      row.label = part.label;
      row.icon = part.icon;
      put(std::move(row));
    }
    end();
  }

 private:
  void begin(const char* list, const char* label) {
    at_ = rows_.size();
    OutlineRow head;
    head.kind = OutlineRow::Kind::section;
    head.thing = {list, ""};
    head.label = label;
    head.open = !filter_.empty() || !folded_.contains(fold_key(head));
    rows_.push_back(std::move(head));
  }

  /// A section with nothing in it is not listed.
  void end() {
    if (rows_[at_].count == 0) rows_.resize(at_);
  }

  void put(OutlineRow row) {
    if (!filter_.empty() && !holds(row.label, filter_)) return;
    ++rows_[at_].count;
    if (rows_[at_].open) rows_.push_back(std::move(row));
  }

  template <class Item>
  static const std::string& group_of(const Item& item) {
    static const std::string none;
    if constexpr (requires { item.group; }) return item.group;
    return none;
  }

  template <class Items>
  static std::size_t first_of(const Items& items, const std::string& group) {
    const auto at = std::find_if(items.begin(), items.end(), [&](const auto& item) { return group_of(item) == group; });
    return static_cast<std::size_t>(at - items.begin());
  }

  template <class Item>
  static OutlineRow thing_row(const Section& section, const Item& item) {
    OutlineRow row;
    row.thing = {section.list, item.name};
    row.label = item.name;
    row.icon = section.icon;
    row.group = group_of(item);
    if constexpr (requires { item.hidden; }) {
      row.can_hide = true;
      row.hidden = item.hidden;
      row.locked = item.locked;
    }
    return row;
  }

  template <class Items>
  void add_group(const Section& section, const Items& items, const std::string& group) {
    OutlineRow head;
    head.kind = OutlineRow::Kind::group;
    head.thing = {section.list, group};
    head.label = group;
    head.icon = "group";
    head.can_hide = head.hidden = head.locked = true;
    std::vector<OutlineRow> members;
    for (const auto& item : items) {
      if (group_of(item) != group) continue;
      members.push_back(thing_row(section, item));
      members.back().inside = true;
      head.hidden = head.hidden && members.back().hidden;
      head.locked = head.locked && members.back().locked;
    }
    head.count = members.size();
    head.open = !folded_.contains(fold_key(head));
    rows_[at_].count += members.size();
    if (!rows_[at_].open) return;
    const bool open = head.open;
    rows_.push_back(std::move(head));
    if (open) std::move(members.begin(), members.end(), std::back_inserter(rows_));
  }

  std::vector<OutlineRow>& rows_;
  const std::set<std::string>& folded_;
  std::string_view filter_;
  std::size_t at_ = 0;
};

template <class Items>
std::optional<std::size_t> place_in(const Items& items, const std::string& name) {
  const auto at = std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
  if (at == items.end()) return std::nullopt;
  return static_cast<std::size_t>(at - items.begin());
}

template <class Items>
std::vector<Edit> reordered(const Items& items, const Thing& thing, const Thing& beside, bool after) {
  const auto from = place_in(items, thing.name), by = place_in(items, beside.name);
  if (!from || !by || *from == *by) return {};
  std::vector<Edit> edits;
  if constexpr (requires { items[0].group; }) {
    const std::string& group = items[*by].group;
    if (items[*from].group != group) edits.push_back({Edit::Kind::group, thing.list, thing.name, "", Value(group)});
  }
  std::size_t to = *by + (after ? 1 : 0);
  if (*from < to) --to;  // it leaves its place first
  if (to != *from) {
    edits.push_back({Edit::Kind::move, thing.list, thing.name, "", Value(static_cast<double>(to))});
  }
  return edits;
}

}  // namespace

std::vector<OutlineRow> outline_rows(const Project& project, const std::set<std::string>& folded,
                                     std::string_view filter) {
  std::vector<OutlineRow> rows;
  SectionRows section(rows, folded, filter);
  section.add(sections[0], project.surfaces);
  section.add(sections[1], project.objects);
  section.add(sections[2], project.lights);
  section.add(sections[3], project.projectors);
  section.add_rig();
  return rows;
}

std::string fold_key(const OutlineRow& row) { return row.thing.list + "/" + row.thing.name; }

std::vector<Thing> members_of(const Project& project, const Thing& group) {
  std::vector<Thing> members;
  const auto add = [&](const auto& items) {
    for (const auto& item : items) {
      if (item.group == group.name) members.push_back({group.list, item.name});
    }
  };
  if (group.list == "surfaces") add(project.surfaces);
  if (group.list == "objects") add(project.objects);
  return members;
}

std::vector<Thing> things_of(const Project& project, const OutlineRow& row) {
  if (row.kind == OutlineRow::Kind::group) return members_of(project, row.thing);
  return {row.thing};
}

std::vector<Edit> reorder_edits(const Project& project, const Thing& thing, const Thing& beside, bool after) {
  if (thing.list != beside.list) return {};
  if (thing.list == "surfaces") return reordered(project.surfaces, thing, beside, after);
  if (thing.list == "objects") return reordered(project.objects, thing, beside, after);
  if (thing.list == "lights") return reordered(project.lights, thing, beside, after);
  if (thing.list == "projectors") return reordered(project.projectors, thing, beside, after);
  return {};
}

}  // namespace focalstage
