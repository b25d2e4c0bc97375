#include "editor/session/folder_listing.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>

using namespace focalstage;
namespace fs = std::filesystem;

namespace {

struct Folder : TemporaryFolder {
  void file(const fs::path& name, std::size_t bytes = 1) const {
    fs::create_directories((path() / name).parent_path());
    std::ofstream(path() / name) << std::string(bytes, 'x');
  }
};

std::vector<std::string> names(const fs::path& folder, Listed wanted) {
  std::vector<std::string> found;
  const auto entries = list_folder(folder, wanted);
  REQUIRE(entries.ok());
  for (const FolderEntry& entry : *entries) found.push_back(entry.name);
  return found;
}

/// A moment of the local clock.
fs::file_time_type at(int year, int month, int day, int hour, int minute) {
  std::tm time{};
  time.tm_year = year - 1900;
  time.tm_mon = month - 1;
  time.tm_mday = day;
  time.tm_hour = hour;
  time.tm_min = minute;
  time.tm_isdst = -1;
  return std::chrono::file_clock::from_sys(std::chrono::system_clock::from_time_t(std::mktime(&time)));
}

}  // namespace

TEST_CASE("a folder lists folders first, then what is wanted, by name") {
  const Folder folder;
  folder.file("b.GLB");
  folder.file("a.focal");
  folder.file("c.txt");
  folder.file("d.png");
  folder.file(".hidden/x");
  folder.file("Zoo/show.focal");
  folder.file("arch/readme");
  using Names = std::vector<std::string>;
  CHECK(names(folder.path(), Listed::projects) == Names{"arch", "Zoo", "a.focal"});
  CHECK(names(folder.path(), Listed::assets) == Names{"arch", "Zoo", "b.GLB", "d.png"});
  CHECK(names(folder.path(), Listed::folders) == Names{"arch", "Zoo"});
  CHECK(names(folder.path(), Listed::everything) == Names{"arch", "Zoo", "a.focal", "b.GLB", "c.txt", "d.png"});
  const auto entries = list_folder(folder.path(), Listed::projects);
  CHECK_FALSE((*entries)[0].project);
  CHECK((*entries)[1].project);
}

TEST_CASE("a folder that cannot be read says so") {
  const Folder folder;
  const auto missing = list_folder(folder.path() / "none", Listed::everything);
  REQUIRE_FALSE(missing.ok());
  CHECK(missing.fault().code == "folder.unreadable");
  CHECK(missing.fault().message == "No such file or directory");
}

TEST_CASE("typed paths begin at home, at the root or at the folder in view") {
  setenv("HOME", "/home/anna", 1);
  CHECK(typed_path("~", "/tmp") == "/home/anna");
  CHECK(typed_path(" ~/shows/../a ", "/tmp") == "/home/anna/a");
  CHECK(typed_path("/etc", "/tmp") == "/etc");
  CHECK(typed_path("b/c", "/tmp") == "/tmp/b/c");
  CHECK(typed_path("..", "/tmp/x") == "/tmp/");
}

TEST_CASE("sizes and times are said as people say them") {
  CHECK(size_words(1) == "1 byte");
  CHECK(size_words(999) == "999 bytes");
  CHECK(size_words(1234) == "1.2 kB");
  CHECK(size_words(999600) == "1.0 MB");  // 999.6 kB would round to 1000 kB
  CHECK(size_words(45000000) == "45 MB");
  const auto now = at(2024, 3, 5, 14, 30);
  CHECK(time_words(now, now) == "just now");
  CHECK(time_words(now - std::chrono::minutes(1), now) == "1 minute ago");
  CHECK(time_words(now - std::chrono::minutes(59), now) == "59 minutes ago");
  CHECK(time_words(at(2024, 3, 5, 9, 5), now) == "today 9:05");
  CHECK(time_words(at(2024, 3, 4, 23, 59), now) == "yesterday 23:59");
  CHECK(time_words(at(2024, 2, 29, 12, 0), now) == "29 Feb 2024");
  CHECK(time_words(at(2024, 3, 6, 12, 0), now) == "6 Mar 2024");  // a clock that was wrong
}
