#pragma once

#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "editor/tools/handle_frame.h"
#include "editor/tools/room_view.h"

namespace focalstage {

/// What a hand can take hold of. An axis: move along it, turn about it. A plane of two axes: move in it. `view`: move
/// square to the line of view, turn about it, scale.
enum class Handle { x, y, z, yz, zx, xy, view };

/// The axis number of x, y and z; of a plane, the axis it is square to; none for `view`.
std::optional<std::size_t> axis_of(Handle handle);
bool is_plane(Handle handle);

/// One drawn piece of a handle, in the view's pixels.
struct HandleShape {
  Handle handle = Handle::view;
  std::vector<glm::dvec2> points_px;
  bool closed = false;
  bool filled = false;
  double opacity = 1.0;  ///< less where the handle runs almost along the line of view
};

/// The handles of a tool, those to be drawn first coming first. `scale` is the window's. Nothing where the frame lies
/// behind the camera, and for `measure`.
std::vector<HandleShape> handle_shapes(HandleTool tool, const HandleFrame& frame, const RoomView& view,
                                       double scale = 1.0);

/// The handle under the pointer: the nearest within reach, the one drawn on top of those equally near.
std::optional<Handle> handle_at(const std::vector<HandleShape>& shapes, const glm::dvec2& pixel, double scale = 1.0);

}  // namespace focalstage
