#pragma once

#include "editor/window/base/pane.h"

namespace focalstage {

class Session;

inline constexpr const char* off_rig_popup = "off-rig";

/// By how much each part of the rig that the eye's view shows is off, once opened: a slider for each. Stands at the
/// right of `beside`, where the window has room.
void draw_off_rig_popup(Session& session, const PaneRect& beside);

}  // namespace focalstage
