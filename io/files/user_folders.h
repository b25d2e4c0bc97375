#pragma once

#include <filesystem>

namespace focalstage {

/// Where this program keeps what is the user's but no project's (the XDG base directories): XDG_STATE_HOME and
/// XDG_CONFIG_HOME, or their defaults below HOME, with "focalstage" appended.
std::filesystem::path user_state_folder();
std::filesystem::path user_config_folder();

}  // namespace focalstage
