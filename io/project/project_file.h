#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/scene/finding.h"
#include "core/scene/project.h"

namespace focalstage {

struct LoadedProject {
  Project project;
  std::vector<Finding> notes;  ///< info: unknown keys kept, an older version read
  std::filesystem::path file;  ///< NAME/NAME.focal
  std::string text;            ///< the bytes as read
};

/// Finds the file of PROJECT: a `NAME.focal`, or the folder that holds one.
Result<std::filesystem::path> project_file(const std::filesystem::path& project);

/// Reads, checks against the published schema, and builds a project. Faults name the file, the JSON pointer, the cause
/// and the remedy.
Result<LoadedProject> load_project(const std::filesystem::path& project);

/// The same from text alone (a show's `/project`, a pushed edit); `source` names it in faults.
Result<LoadedProject> parse_project(std::string_view text, const std::string& source);

/// The text of a project file, unknown keys included.
std::string project_text(const Project& project);

/// Replaces the file atomically.
Status save_project(const Project& project, const std::filesystem::path& file);

}  // namespace focalstage
