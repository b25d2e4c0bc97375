#pragma once

#include <memory>

#include "editor/window/base/panel.h"

namespace focalstage {

/// What the session says in passing, at the lower edge; faults stay until they are dismissed.
std::unique_ptr<Panel> make_notice_panel();

}  // namespace focalstage
