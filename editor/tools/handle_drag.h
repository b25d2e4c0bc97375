#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "editor/tools/handle_frame.h"
#include "editor/tools/handle_shapes.h"
#include "editor/tools/room_view.h"

namespace focalstage {

/// A hand that holds a handle: what was true when it took hold. All that follows is counted from there.
struct HandleDrag {
  HandleTool tool = HandleTool::move;
  Handle handle = Handle::view;
  HandleFrame frame;
  RoomView view;
  glm::dvec2 start_px{0.0};
  glm::dvec3 viewer_m{0.0};
  std::vector<HandleThing> things;
};

/// How the hand wants it.
struct DragWish {
  bool snap = false;
  double snap_m = 0.01;
  double snap_deg = 5.0;
  double snap_factor = 0.05;
  /// Along the sight: grow with the distance, so that nothing changes for the viewer but the distance.
  bool keep_angular_size = false;
};

/// What became of it: every thing as it is to be now, and how far it went in words ("0.120 m").
struct Dragged {
  std::vector<HandleThing> things;
  std::string amount;
  bool operator==(const Dragged&) const = default;
};

HandleDrag drag_start(HandleTool tool, Handle handle, const HandleFrame& frame, const RoomView& view,
                      const glm::dvec2& start_px, const Rigid& world_from_viewer, std::vector<HandleThing> things);

/// The pointer is at `pixel`. Where it points beyond the horizon of an axis or a plane, what went before the horizon
/// counts.
Dragged drag_to(const HandleDrag& drag, const glm::dvec2& pixel, const DragWish& wish);

/// The amount was typed: metres along the handle's axis, or along each of its two; degrees; a factor. Nothing is
/// snapped. Numbers too many are left aside, those missing are zero (a factor: one).
Dragged drag_by(const HandleDrag& drag, std::span<const double> numbers, const DragWish& wish);

}  // namespace focalstage
