#pragma once

#include <memory>

#include "editor/window/base/panel.h"

namespace focalstage {

/// Every command and every thing by its name, above all else.
std::unique_ptr<Panel> make_palette_panel();

}  // namespace focalstage
