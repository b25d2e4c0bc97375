#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/value.h"

namespace focalstage {

struct Project;

/// One change of a project, as data: what undo, the journal, scripts, live links and remedies all speak.
///
///   set     list, name, key, value     `key` may reach inside with slashes ("depth/vergence_d"); a null value removes
///   an
///                                      optional key; `name` is empty for the single things (viewer, glasses, sweep,
///                                      slices, frames) and for the project itself (list "")
///   add     list, name, value          `value` the whole item; at the end of the list, or before `key` if that names
///   an item remove  list, name rename  list, name, value          `value` the new name; what refers to the old one
///   follows move    list, name, value          `value` the new place in the list, from 0 group   list, name, value
///   `value` the group's name, "" to leave it
struct Edit {
  enum class Kind { set, add, remove, rename, move, group };

  Kind kind = Kind::set;
  std::string list;
  std::string name;
  std::string key;
  Value value;

  bool operator==(const Edit&) const = default;
};

/// The project after `edit`; the project given is untouched. Fault codes "edit.*" name list, name and key.
Result<Project> apply(const Project& project, const Edit& edit);

/// All of them in order, or the first fault and nothing.
Result<Project> apply_all(const Project& project, const std::vector<Edit>& edits);

/// The edit as the object of its JSON line, and back.
Value value_from(const Edit& edit);
Result<Edit> edit_from(const Value& value);

}  // namespace focalstage
