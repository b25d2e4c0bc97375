#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/edit.h"
#include "editor/session/thing.h"

namespace focalstage {

/// One line of the outline.
struct OutlineRow {
  enum class Kind { section, group, thing };

  Kind kind = Kind::thing;
  Thing thing;        ///< of a group: its list and its name; of a section: its list
  std::string label;  ///< what a person reads
  std::string icon;
  std::string group;      ///< the one a thing stands in
  bool inside = false;    ///< a group's: a step further right
  bool open = true;       ///< of sections and groups: what follows is listed
  bool can_hide = false;  ///< surfaces and objects, and groups of them
  bool hidden = false;    ///< of a group: all of it
  bool locked = false;
  std::size_t count = 0;  ///< of sections and groups: how many things they hold

  bool operator==(const OutlineRow&) const = default;
};

/// What the outline lists: sections, in them groups where their first thing stands, things. `folded`: `fold_key` of
/// what is closed. With a `filter` all things whose names hold it, in any case of ASCII, whatever is folded.
std::vector<OutlineRow> outline_rows(const Project& project, const std::set<std::string>& folded,
                                     std::string_view filter = {});

/// What a section or a group is known by among those folded.
std::string fold_key(const OutlineRow& row);

/// The things of a group, in the order of their list.
std::vector<Thing> members_of(const Project& project, const Thing& group);

/// What a row stands for: the things of a group, else the one.
std::vector<Thing> things_of(const Project& project, const OutlineRow& row);

/// Edits that put a thing before or after another of its list, and into the group that one stands in; none where
/// nothing would change.
std::vector<Edit> reorder_edits(const Project& project, const Thing& thing, const Thing& beside, bool after);

}  // namespace focalstage
