#pragma once

#include <memory>

#include "editor/window/base/panel.h"

namespace focalstage {

/// The strip below the views: frames, play, keys of the selected thing, cues.
std::unique_ptr<Panel> make_timeline_panel();

}  // namespace focalstage
