#pragma once

#include <memory>

#include "editor/window/base/panel.h"

namespace focalstage {

/// Asks for the path that a command needs: a project to open, a folder to save into, a file to import.
std::unique_ptr<Panel> make_file_panel();

}  // namespace focalstage
