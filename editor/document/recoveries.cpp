#include <algorithm>
#include <system_error>

#include "editor/document/document.h"
#include "editor/document/replay.h"
#include "io/files/files.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

constexpr const char* suffix = ".journal";

void add_if_left(std::vector<Recovery>& found, const fs::path& journal) {
  std::error_code none;
  if (!fs::is_regular_file(journal, none)) return;
  const auto content = read_journal(journal);
  if (!content) return;
  Recovery recovery{journal, content->start.project_file, content->start.untitled, words_of(content->records), {}};
  recovery.when = fs::last_write_time(journal, none);
  // Nothing done, nothing lost.
  if (!recovery.words.empty()) found.push_back(std::move(recovery));
}

void add_folder(std::vector<Recovery>& found, const fs::path& folder) {
  std::error_code none;
  for (fs::directory_iterator at(folder, none), end; !none && at != end; at.increment(none)) {
    if (at->path().extension() == suffix) add_if_left(found, at->path());
  }
}

}  // namespace

fs::path journal_beside(const fs::path& project_file) {
  return project_file.parent_path() / ("." + project_file.filename().string() + suffix);
}

fs::path journal_in_state(const fs::path& project_file, const UserFolders& folders) {
  return folders.state / "journals" / (sha256_hex(project_file.string()).substr(0, 16) + suffix);
}

std::vector<Recovery> recoveries(const UserFolders& folders, const std::vector<fs::path>& recent) {
  std::vector<Recovery> found;
  for (const fs::path& file : recent) add_if_left(found, journal_beside(file));
  add_folder(found, folders.state / "journals");
  std::error_code none;
  for (fs::directory_iterator at(folders.state / "unsaved", none), end; !none && at != end; at.increment(none)) {
    add_folder(found, at->path());
  }
  std::sort(found.begin(), found.end(), [](const Recovery& a, const Recovery& b) { return a.when > b.when; });
  return found;
}

void forget(const Recovery& recovery) {
  std::error_code ignored;
  fs::remove(recovery.journal, ignored);
  if (recovery.untitled) fs::remove_all(fs::path(recovery.project_file).parent_path(), ignored);
}

}  // namespace focalstage
