#pragma once

#include "editor/window/base/pane.h"

namespace focalstage {

/// A window in the middle that everything else waits for, the rest dimmed. True while it is there, then `end_dialog`.
/// `height_px` 0: what it needs.
bool begin_dialog(const char* id, const PaneRect& window, float width_px, float height_px = 0.0f);
void end_dialog();

/// Closes the dialog that is being drawn.
void close_dialog();

}  // namespace focalstage
