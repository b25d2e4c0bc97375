#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/finding.h"
#include "core/scene/project.h"
#include "core/scene/value.h"

namespace focalstage {

/// The version of the project file that this program writes: its member "focalstage".
inline constexpr int project_version = 1;

/// The project that a value of design section 4's shape describes, with everything checked that must hold for a project
/// to be worked on. Faults "project.*" carry the JSON pointer in `where`. Members this version does not know are kept
/// and noted, as info findings "project.unknown-key".
Result<Project> project_from(const Value& value, std::vector<Finding>* notes = nullptr);

/// The value to write: every key of design section 4's example, and the optional ones that differ from their defaults.
Value value_from(const Project& project);

/// What makes a project made in memory unfit to be worked on, if anything; the faults of project_from.
std::optional<Fault> fault_of(const Project& project);

/// Every key a project file may have, as pointers with "*" for the items of a list: "/objects/*/depth/mode".
std::vector<std::string> project_keys();

}  // namespace focalstage
