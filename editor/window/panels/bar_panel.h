#pragma once

#include <memory>

#include "editor/window/base/panel.h"

namespace focalstage {

std::unique_ptr<Panel> make_bar_panel();

}  // namespace focalstage
