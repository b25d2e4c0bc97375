#pragma once

#include <filesystem>

namespace focalstage {

/// Where the editor keeps what is the user's but no project's (the XDG base directories).
struct UserFolders {
  std::filesystem::path state;   ///< unsaved projects, journals, recent files, the simulated rig's shows
  std::filesystem::path config;  ///< the window's layout, models of projectors

  /// XDG_STATE_HOME and XDG_CONFIG_HOME, or their defaults below HOME.
  static UserFolders of_environment();
};

}  // namespace focalstage
