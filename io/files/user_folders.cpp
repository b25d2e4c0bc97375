#include "io/files/user_folders.h"

#include <cstdlib>

namespace focalstage {
namespace {

std::filesystem::path base_folder(const char* variable, const char* below_home) {
  // The base directory specification: a relative path in the variable counts as none.
  if (const char* set = std::getenv(variable); set != nullptr && *set == '/') return set;
  const char* home = std::getenv("HOME");
  return std::filesystem::path(home != nullptr && *home == '/' ? home : "/var/tmp") / below_home;
}

}  // namespace

std::filesystem::path user_state_folder() { return base_folder("XDG_STATE_HOME", ".local/state") / "focalstage"; }

std::filesystem::path user_config_folder() { return base_folder("XDG_CONFIG_HOME", ".config") / "focalstage"; }

}  // namespace focalstage
