#pragma once

#include <memory>

#include "editor/window/base/panel.h"

namespace focalstage {

/// The tab of all steps: a click goes back, or forward, to any of them.
std::unique_ptr<Panel> make_history_panel();

}  // namespace focalstage
