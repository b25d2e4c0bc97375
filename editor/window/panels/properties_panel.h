#pragma once

#include <memory>

#include "editor/window/base/panel.h"

namespace focalstage {

/// Right: what is selected, row by row; each row a field that becomes edits.
std::unique_ptr<Panel> make_properties_panel();

}  // namespace focalstage
