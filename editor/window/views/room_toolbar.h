#pragma once

#include "editor/window/views/room_frame.h"

namespace focalstage {

/// The chips over the room: tools, axes, snapping, and a menu of what is shown and from where.
void draw_room_toolbar(RoomFrame& frame);

}  // namespace focalstage
