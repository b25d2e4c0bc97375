#pragma once

#include <memory>

#include "editor/window/base/panel.h"

namespace focalstage {

/// What the window shows while nothing is open.
std::unique_ptr<Panel> make_start_panel();

}  // namespace focalstage
