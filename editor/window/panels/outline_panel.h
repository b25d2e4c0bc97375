#pragma once

#include <memory>

#include "editor/window/base/panel.h"

namespace focalstage {

/// Left: everything there is, by kind. Selects, renames, hides, locks, reorders and adds.
std::unique_ptr<Panel> make_outline_panel();

}  // namespace focalstage
