#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

/// What a browser of files is looking for.
enum class Listed { projects, assets, folders, everything };

struct FolderEntry {
  std::string name;
  std::filesystem::path path;
  bool folder = false;
  bool project = false;  ///< a folder that holds a *.focal
  std::uintmax_t bytes = 0;
  std::filesystem::file_time_type when{};
};

/// What a folder holds, folders first, by name without regard to case; hidden ones left out, of files only those
/// wanted. Fault "folder.unreadable".
Result<std::vector<FolderEntry>> list_folder(const std::filesystem::path& folder, Listed wanted);

/// Whether `file` is one of those, by its ending.
bool is_wanted(const std::filesystem::path& file, Listed wanted);

/// What a person typed as a path: "~" is the home folder, what is relative begins at `from`.
std::filesystem::path typed_path(std::string_view typed, const std::filesystem::path& from);

std::filesystem::path home_folder();

/// "740 bytes", "1.2 MB"
std::string size_words(std::uintmax_t bytes);

/// "just now", "5 minutes ago", "today 14:03", "yesterday 9:15", "3 Mar 2024"; by the local clock.
std::string time_words(std::filesystem::file_time_type when, std::filesystem::file_time_type now);

}  // namespace focalstage
