#include "editor/document/recent.h"

#include <algorithm>
#include <system_error>

#include "io/files/files.h"
#include "io/json/json.h"

namespace focalstage {
namespace {

constexpr std::size_t most_recent = 12;

std::filesystem::path list_file(const UserFolders& folders) { return folders.state / "recent.json"; }

std::vector<std::filesystem::path> listed(const UserFolders& folders) {
  const auto bytes = read_file(list_file(folders), 1u << 20);
  if (!bytes) return {};
  const auto value = parse_json({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, "recent.json");
  if (!value || !value->array()) return {};
  std::vector<std::filesystem::path> paths;
  for (const Value& item : *value->array()) {
    if (item.text()) paths.emplace_back(*item.text());
  }
  return paths;
}

}  // namespace

std::vector<std::filesystem::path> recent_projects(const UserFolders& folders) {
  std::vector<std::filesystem::path> paths = listed(folders);
  std::erase_if(paths, [](const auto& path) {
    std::error_code none;
    return !std::filesystem::is_regular_file(path, none);
  });
  return paths;
}

void remember_recent(const std::filesystem::path& project_file, const UserFolders& folders) {
  std::vector<std::filesystem::path> paths = listed(folders);
  std::erase(paths, project_file);
  paths.insert(paths.begin(), project_file);
  if (paths.size() > most_recent) paths.resize(most_recent);
  Value::Array array;
  for (const auto& path : paths) array.emplace_back(path.string());
  std::error_code none;
  std::filesystem::create_directories(folders.state, none);
  // A list that cannot be kept is no reason to bother anybody.
  (void)write_file_atomically(list_file(folders), write_json(Value(std::move(array))));
}

}  // namespace focalstage
