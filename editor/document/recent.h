#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "editor/document/folders.h"

namespace focalstage {

/// Project files opened lately, the newest first, at most twelve; those that are gone are left out.
std::vector<std::filesystem::path> recent_projects(const UserFolders& folders);
void remember_recent(const std::filesystem::path& project_file, const UserFolders& folders);

/// Addresses of rigs connected to lately, the newest first, at most six.
std::vector<std::string> recent_rigs(const UserFolders& folders);
void remember_rig(const std::string& address, const UserFolders& folders);

}  // namespace focalstage
