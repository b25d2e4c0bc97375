#include "editor/document/recent.h"

#include <algorithm>
#include <system_error>

#include "io/files/files.h"
#include "io/json/json.h"

namespace focalstage {
namespace {

constexpr const char* projects_list = "recent.json";
constexpr std::size_t most_projects = 12;
constexpr const char* rigs_list = "rigs.json";
constexpr std::size_t most_rigs = 6;

std::vector<std::string> listed(const UserFolders& folders, const char* list) {
  const auto bytes = read_file(folders.state / list, 1u << 20);
  if (!bytes) return {};
  const auto value = parse_json({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, list);
  if (!value || !value->array()) return {};
  std::vector<std::string> texts;
  for (const Value& item : *value->array()) {
    if (item.text()) texts.push_back(*item.text());
  }
  return texts;
}

/// Puts `text` first.
void remember(const std::string& text, const UserFolders& folders, const char* list, std::size_t most) {
  std::vector<std::string> texts = listed(folders, list);
  std::erase(texts, text);
  texts.insert(texts.begin(), text);
  if (texts.size() > most) texts.resize(most);
  Value::Array array;
  for (const std::string& one : texts) array.emplace_back(one);
  std::error_code none;
  std::filesystem::create_directories(folders.state, none);
  // A list that cannot be kept is no reason to bother anybody.
  (void)write_file_atomically(folders.state / list, write_json(Value(std::move(array))));
}

}  // namespace

std::vector<std::filesystem::path> recent_projects(const UserFolders& folders) {
  std::vector<std::filesystem::path> paths;
  for (const std::string& text : listed(folders, projects_list)) {
    std::error_code none;
    if (std::filesystem::is_regular_file(text, none)) paths.emplace_back(text);
  }
  return paths;
}

void remember_recent(const std::filesystem::path& project_file, const UserFolders& folders) {
  remember(project_file.string(), folders, projects_list, most_projects);
}

std::vector<std::string> recent_rigs(const UserFolders& folders) { return listed(folders, rigs_list); }

void remember_rig(const std::string& address, const UserFolders& folders) {
  remember(address, folders, rigs_list, most_rigs);
}

}  // namespace focalstage
