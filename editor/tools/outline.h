#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "core/stage/stage.h"
#include "editor/tools/room_view.h"

namespace focalstage {

/// A closed line round what is seen, in the view's pixels.
using Outline = std::vector<glm::dvec2>;

/// The outlines of drawables as they are seen together, holes included, hidden by nothing. `cell_px`: how fine they are
/// taken (2 at a window's scale of 2). Parts outside the picture and before the near plane are left out.
std::vector<Outline> outlines(const RoomView& view, const std::vector<Drawable>& drawables, double cell_px = 1.0);

}  // namespace focalstage
