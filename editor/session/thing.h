#pragma once

#include <compare>
#include <string>
#include <vector>

#include "core/scene/project.h"

namespace focalstage {

/// One thing of a project, as edits name it: ("objects", "rabbit"), ("viewer", ""), ("lights", "sun").
struct Thing {
  std::string list;
  std::string name;

  auto operator<=>(const Thing&) const = default;
};

/// Everything the outline lists, in its order: surfaces, objects, lights, projectors, the viewer (as ("viewer", "")),
/// and what has no place in the room: glasses, sweep, slices, frames.
std::vector<Thing> things_of(const Project& project);

bool exists(const Project& project, const Thing& thing);

/// Whether it has a pose of its own in the room that can be set (position_m and rotation_xyzw).
bool stands_in_room(const Thing& thing);

const Object* object_named(const Project& project, const std::string& name);
const Surface* surface_named(const Project& project, const std::string& name);

/// What a person calls it: its name; "Viewer", "Glasses", "Sweep" for those without one.
std::string title_of(const Thing& thing);

/// `wanted`, or "wanted 2", "wanted 3" ... where the list has it already.
std::string free_name(const Project& project, const std::string& list, const std::string& wanted);

/// The thing a JSON pointer of a finding leads to ("/objects/2/depth" -> the third object); an empty list: the project.
Thing thing_at(const Project& project, const std::string& pointer);

}  // namespace focalstage
