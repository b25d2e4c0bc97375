#pragma once

#include <memory>
#include <vector>

#include "editor/window/base/panel.h"

namespace focalstage {

/// All panels of the window, those of one place in their order from the left.
std::vector<std::unique_ptr<Panel>> make_panels();

}  // namespace focalstage
