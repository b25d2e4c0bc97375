#include "editor/document/folders.h"

#include "io/files/user_folders.h"

namespace focalstage {

UserFolders UserFolders::of_environment() { return {user_state_folder(), user_config_folder()}; }

}  // namespace focalstage
