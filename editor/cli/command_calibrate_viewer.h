#pragma once

#include <functional>

#include "editor/cli/command.h"

namespace CLI {
class App;
}

namespace focalstage {

/// Adds `viewer` with its actions below `focalstage calibrate`; the one that was chosen is handed to `choose`.
void declare_calibrate_viewer(CLI::App& calibrate, const std::function<void(Command::Run)>& choose);

}  // namespace focalstage
