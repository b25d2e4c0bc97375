#pragma once

#include <memory>

#include "editor/window/base/panel.h"

namespace focalstage {

/// What the solver proposes, in words, beside its marks in the sweep: to be applied or discarded.
std::unique_ptr<Panel> make_solve_panel();

}  // namespace focalstage
