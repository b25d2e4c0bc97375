#include "editor/session/folder_listing.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <system_error>

namespace focalstage {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 9> asset_endings{".glb", ".gltf", ".jpeg", ".jpg", ".obj",
                                                        ".off", ".ply",  ".png",  ".stl"};
/// More than anybody reads in a list.
constexpr std::size_t most_entries = 5000;

std::string lowered(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool holds_project(const fs::path& folder) {
  std::error_code problem;
  fs::directory_iterator at(folder, problem);
  // A project stands near the front of its own folder; a huge folder is none.
  for (int i = 0; !problem && at != fs::directory_iterator() && i < 200; at.increment(problem), ++i) {
    if (at->path().extension() == ".focal") return true;
  }
  return false;
}

FolderEntry entry_of(const fs::directory_entry& found) {
  std::error_code none;
  FolderEntry entry{found.path().filename().string(), found.path(), found.is_directory(none), false, 0, {}};
  if (!entry.folder) entry.bytes = found.file_size(none);
  entry.when = found.last_write_time(none);
  return entry;
}

std::string clock_words(const std::tm& time) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%d:%02d", time.tm_hour, time.tm_min);
  return text.data();
}

std::tm local(std::time_t seconds) {
  std::tm time{};
  localtime_r(&seconds, &time);
  return time;
}

}  // namespace

bool is_wanted(const fs::path& file, Listed wanted) {
  const std::string ending = lowered(file.extension().string());
  switch (wanted) {
    case Listed::projects:
      return ending == ".focal";
    case Listed::assets:
      return std::ranges::find(asset_endings, ending) != asset_endings.end();
    case Listed::folders:
      return false;
    case Listed::everything:
      break;
  }
  return true;
}

Result<std::vector<FolderEntry>> list_folder(const fs::path& folder, Listed wanted) {
  std::error_code problem;
  fs::directory_iterator at(folder, problem);
  std::vector<FolderEntry> entries;
  for (; !problem && at != fs::directory_iterator(); at.increment(problem)) {
    FolderEntry entry = entry_of(*at);
    if (entry.name.starts_with('.')) continue;
    if (!entry.folder && !is_wanted(entry.path, wanted)) continue;
    entries.push_back(std::move(entry));
    if (entries.size() == most_entries) break;
  }
  if (problem) return Fault{"folder.unreadable", folder.string(), problem.message(), "choose another folder"};
  std::ranges::sort(entries, [](const FolderEntry& a, const FolderEntry& b) {
    if (a.folder != b.folder) return a.folder;
    const std::string left = lowered(a.name), right = lowered(b.name);
    return left != right ? left < right : a.name < b.name;
  });
  for (FolderEntry& entry : entries) entry.project = entry.folder && holds_project(entry.path);
  return entries;
}

fs::path home_folder() {
  const char* home = std::getenv("HOME");
  return home && *home ? fs::path(home) : fs::path("/");
}

fs::path typed_path(std::string_view typed, const fs::path& from) {
  while (!typed.empty() && typed.front() == ' ') typed.remove_prefix(1);
  while (!typed.empty() && typed.back() == ' ') typed.remove_suffix(1);
  if (typed == "~") return home_folder();
  if (typed.starts_with("~/")) return (home_folder() / typed.substr(2)).lexically_normal();
  return (from / typed).lexically_normal();
}

std::string size_words(std::uintmax_t bytes) {
  if (bytes < 1000) return std::to_string(bytes) + (bytes == 1 ? " byte" : " bytes");
  constexpr std::array<const char*, 4> units{"kB", "MB", "GB", "TB"};
  double size = static_cast<double>(bytes) / 1000.0;
  std::size_t unit = 0;
  for (; size >= 999.5 && unit + 1 < units.size(); ++unit) size /= 1000.0;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), size < 9.95 ? "%.1f %s" : "%.0f %s", size, units[unit]);
  return text.data();
}

std::string time_words(fs::file_time_type when, fs::file_time_type now) {
  using std::chrono::duration_cast;
  const auto age_s = duration_cast<std::chrono::seconds>(now - when).count();
  if (age_s >= 0 && age_s < 60) return "just now";
  if (age_s >= 0 && age_s < 3600) {
    return std::to_string(age_s / 60) + (age_s < 120 ? " minute ago" : " minutes ago");
  }
  const auto seconds_of = [](fs::file_time_type time) {
    const auto since = std::chrono::file_clock::to_sys(time).time_since_epoch();
    return static_cast<std::time_t>(duration_cast<std::chrono::seconds>(since).count());
  };
  const std::time_t today_s = seconds_of(now);
  const std::tm then = local(seconds_of(when)), today = local(today_s);
  std::tm noon = today;  // a day before noon is yesterday, also where clocks were set forward at night
  noon.tm_hour = 12;
  const std::tm yesterday = local(std::mktime(&noon) - 86400);
  const auto same_day = [&](const std::tm& day) { return then.tm_year == day.tm_year && then.tm_yday == day.tm_yday; };
  if (same_day(today)) return "today " + clock_words(then);
  if (same_day(yesterday)) return "yesterday " + clock_words(then);
  constexpr std::array<const char*, 12> months{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                               "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  return std::to_string(then.tm_mday) + " " + months[static_cast<std::size_t>(then.tm_mon)] + " " +
         std::to_string(then.tm_year + 1900);
}

}  // namespace focalstage
