#pragma once

#include "editor/window/views/room_drawing.h"
#include "editor/window/views/room_frame.h"
#include "editor/window/views/room_hands.h"

namespace focalstage {

// The parts of the room's overlay, from below upwards.

/// Distances from the viewer, along the floor.
void draw_floor_marks(const RoomFrame& frame, RoomDrawing& drawing);
/// Where the viewer looks and what projectors light.
void draw_gaze(const RoomFrame& frame, RoomDrawing& drawing);
void draw_frusta(const RoomFrame& frame, RoomDrawing& drawing);
/// Distances of the slices' image planes, at their upper right corners.
void draw_sheet_labels(const RoomFrame& frame, RoomDrawing& drawing);
/// Which colour is which slice and where its picture stands; what lies beyond infinity is only here.
void draw_slice_legend(const RoomFrame& frame, RoomDrawing& drawing);
/// Names of what is selected, under the pointer, or a surface.
void draw_names(const RoomFrame& frame, const RoomHands& hands, RoomDrawing& drawing);
/// The depth sheet of the selected object with what it comes to in dioptres.
void draw_depth(const RoomFrame& frame, const RoomHands& hands, RoomDrawing& drawing);
void draw_handles(const RoomFrame& frame, const RoomHands& hands, RoomDrawing& drawing);
void draw_measure(const RoomFrame& frame, const RoomHands& hands, RoomDrawing& drawing);
/// The edge of the projector's picture while one looks through it.
void draw_picture_edge(const RoomFrame& frame, RoomDrawing& drawing);
/// What to do first in a room that lacks what a show needs.
void draw_first_steps(const RoomFrame& frame, RoomDrawing& drawing);

}  // namespace focalstage
