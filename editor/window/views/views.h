#pragma once

#include <array>
#include <memory>

#include "editor/window/base/pane.h"

namespace focalstage {

/// The four views of the centre in the order of PaneId; null where there is none.
std::array<std::unique_ptr<Pane>, 4> make_panes();

}  // namespace focalstage
