#pragma once

#include <memory>

#include "editor/window/base/panel.h"

namespace focalstage {

/// The tab of what happened since the editor started.
std::unique_ptr<Panel> make_log_panel();

}  // namespace focalstage
