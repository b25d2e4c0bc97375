#pragma once

#include <optional>
#include <string_view>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/mesh/measure.h"
#include "editor/tools/room_view.h"

namespace focalstage {

/// The room's camera: it orbits `target_m`. Azimuth 0 looks along -Z and grows as it turns to the right; elevation 90
/// looks straight down.
struct RoomCamera {
  glm::dvec3 target_m{0.0, 0.0, -0.4};
  double distance_m = 1.8;
  double azimuth_deg = -35.0;
  double elevation_deg = 22.0;
  bool operator==(const RoomCamera&) const = default;
};

enum class StandardView { front, back, left, right, top, bottom };

/// "front", "top"...; none for any other word.
std::optional<StandardView> standard_view_named(std::string_view name);

RoomView view_of(const RoomCamera& camera, const glm::dvec2& size_px);

/// Turns with a hand that moved by so many pixels, as if it held the room; `per_px_deg` depends on the screen.
RoomCamera orbited(const RoomCamera& camera, const glm::dvec2& moved_px, double per_px_deg = 0.4);

/// Moves with the hand: what lies at the target's depth stays under the pointer.
RoomCamera panned(const RoomCamera& camera, const glm::dvec2& size_px, const glm::dvec2& moved_px);

/// Nearer by `steps` of the wheel (away: negative), towards what lies under `pixel` at the target's depth.
RoomCamera zoomed(const RoomCamera& camera, const glm::dvec2& size_px, const glm::dvec2& pixel, double steps);

/// From the same direction, so that the bounds just fit into nine tenths of the picture. Empty bounds: unchanged.
RoomCamera fitted(const RoomCamera& camera, const glm::dvec2& size_px, const Bounds& bounds);

/// `front` looks at what the viewer sees (along -Z), `top` straight down with -Z up in the picture.
RoomCamera from_side(const RoomCamera& camera, StandardView side);

}  // namespace focalstage
