#include "editor/tools/handle_drag.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "core/base/number_words.h"
#include "editor/tools/nearest_on_line.h"

namespace focalstage {
namespace {

constexpr double nearest_to_viewer_m = 0.02;
constexpr double smallest_factor = 1e-3;
constexpr double largest_factor = 1e3;

/// The axes along which a drag has amounts: one, or two of a plane or of the view.
std::vector<glm::dvec3> axes_of(const HandleDrag& drag) {
  const std::array<glm::dvec3, 3>& axes = drag.frame.axes;
  const std::optional<std::size_t> axis = axis_of(drag.handle);
  if (!axis) {
    return {drag.view.world_from_camera.direction({1.0, 0.0, 0.0}),
            drag.view.world_from_camera.direction({0.0, 1.0, 0.0})};
  }
  if (!is_plane(drag.handle)) return {axes[*axis]};
  // In the order x, y, z: that is how a person types them.
  if (*axis == 0) return {axes[1], axes[2]};
  if (*axis == 1) return {axes[0], axes[2]};
  return {axes[0], axes[1]};
}

glm::dvec3 axis_of_turn(const HandleDrag& drag) {
  const std::optional<std::size_t> axis = axis_of(drag.handle);
  return axis ? drag.frame.axes[*axis] : drag.view.world_from_camera.direction({0.0, 0.0, 1.0});
}

/// Where the pointer's ray meets the plane through the frame's origin, from that origin.
std::optional<glm::dvec3> in_plane_m(const HandleDrag& drag, const glm::dvec3& normal, const glm::dvec2& pixel) {
  const Ray ray = ray_through(drag.view, pixel);
  const double towards = glm::dot(normal, ray.direction);
  if (std::abs(towards) < 1e-6) return std::nullopt;
  const double on_ray_m = glm::dot(normal, drag.frame.origin_m - ray.origin_m) / towards;
  if (on_ray_m <= 0.0) return std::nullopt;
  return ray.at(on_ray_m) - drag.frame.origin_m;
}

/// `at(pixel)`, or where that has no answer, the answer nearest to it on the way from the start.
template <class At>
auto before_horizon(const HandleDrag& drag, const glm::dvec2& pixel, At&& at) -> decltype(at(pixel)) {
  if (const auto there = at(pixel)) return there;
  auto best = at(drag.start_px);
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 12 && best; ++i) {
    const double middle = 0.5 * (low + high);
    if (const auto found = at(drag.start_px + middle * (pixel - drag.start_px))) {
      best = found;
      low = middle;
    } else {
      high = middle;
    }
  }
  return best;
}

double snapped(double amount, double from, double step) {
  return step > 0.0 ? std::round((from + amount) / step) * step - from : amount;
}

/// Metres along each of axes_of().
std::vector<double> moved_m(const HandleDrag& drag, const glm::dvec2& pixel) {
  const std::vector<glm::dvec3> axes = axes_of(drag);
  if (axes.size() == 1) {
    const auto at = [&](const glm::dvec2& p) {
      return nearest_on_line_m({drag.frame.origin_m, axes[0]}, ray_through(drag.view, p));
    };
    const auto from = at(drag.start_px);
    const auto to = before_horizon(drag, pixel, at);
    return {from && to ? *to - *from : 0.0};
  }
  const glm::dvec3 normal = glm::cross(axes[0], axes[1]);
  const auto at = [&](const glm::dvec2& p) { return in_plane_m(drag, normal, p); };
  const auto from = at(drag.start_px);
  const auto to = before_horizon(drag, pixel, at);
  if (!from || !to) return {0.0, 0.0};
  return {glm::dot(axes[0], *to - *from), glm::dot(axes[1], *to - *from)};
}

/// Snapping rounds where the thing comes to stand, wherever its axis has a zero (HandleFrame::coordinates_m).
void snap_moves(const HandleDrag& drag, double step_m, std::vector<double>& amounts_m) {
  const std::vector<glm::dvec3> axes = axes_of(drag);
  for (std::size_t i = 0; i < amounts_m.size(); ++i) {
    double from_m = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (axes[i] == drag.frame.axes[k]) from_m = drag.frame.coordinates_m[static_cast<int>(k)];
    }
    amounts_m[i] = snapped(amounts_m[i], from_m, step_m);
  }
}

std::optional<double> angle_in_plane(const HandleDrag& drag, const glm::dvec3& axis, const glm::dvec2& pixel) {
  const auto arm = in_plane_m(drag, axis, pixel);
  if (!arm || glm::length(*arm) < 1e-9) return std::nullopt;
  glm::dvec3 zero = glm::cross(axis, glm::dvec3(0.0, 0.0, 1.0));
  if (glm::length(zero) < 0.1) zero = glm::cross(axis, glm::dvec3(1.0, 0.0, 0.0));
  zero = glm::normalize(zero);
  return std::atan2(glm::dot(glm::cross(axis, zero), *arm), glm::dot(zero, *arm));
}

/// A ring seen from its edge is turned like a wheel: by how far the hand moved along its line on the screen.
double wheel_deg(const HandleDrag& drag, const glm::dvec3& axis, const glm::dvec2& pixel) {
  const Ray ray = ray_through(drag.view, drag.start_px);
  const double per_px_m = metres_per_px(drag.view, drag.frame.origin_m);
  const glm::dvec3 forward = glm::normalize(glm::cross(axis, -ray.direction));  // the near side's way
  const auto from = pixel_of(drag.view, drag.frame.origin_m);
  const auto to = pixel_of(drag.view, drag.frame.origin_m + per_px_m * forward);
  if (!from || !to || glm::length(*to - *from) < 1e-9) return 0.0;
  constexpr double per_turn_px = 72.0;
  return glm::degrees(glm::dot(pixel - drag.start_px, glm::normalize(*to - *from)) / per_turn_px);
}

double turned_deg(const HandleDrag& drag, const glm::dvec2& pixel) {
  const glm::dvec3 axis = axis_of_turn(drag);
  const glm::dvec3 to_camera = glm::normalize(drag.view.world_from_camera.position_m - drag.frame.origin_m);
  if (std::abs(glm::dot(axis, to_camera)) < 0.25) return wheel_deg(drag, axis, pixel);
  const auto from = angle_in_plane(drag, axis, drag.start_px);
  const auto to = before_horizon(drag, pixel, [&](const glm::dvec2& p) { return angle_in_plane(drag, axis, p); });
  return from && to ? glm::degrees(std::remainder(*to - *from, 2.0 * std::numbers::pi)) : 0.0;
}

/// By how the pointer's distance from the centre grew; taken at the centre itself, by how far it went up or right.
double scaled_by(const HandleDrag& drag, const glm::dvec2& pixel) {
  const auto centre = pixel_of(drag.view, drag.frame.origin_m);
  if (!centre) return 1.0;
  constexpr double at_centre_px = 20.0;
  const double from_px = glm::length(drag.start_px - *centre);
  const glm::dvec2 went = pixel - drag.start_px;
  const double factor = from_px < at_centre_px
                            ? std::exp((went.x - went.y) / 120.0)
                            : glm::dot(pixel - *centre, drag.start_px - *centre) / (from_px * from_px);
  return std::clamp(factor, 0.01, 100.0);
}

/// Everything keeps its own direction from the viewer and comes nearer or goes away by as much.
void move_along_sight(const HandleDrag& drag, double amount_m, bool keep_size, std::vector<HandleThing>& things) {
  const double frame_m = glm::length(drag.frame.origin_m - drag.viewer_m);
  const double all = std::max(frame_m + amount_m, nearest_to_viewer_m) / std::max(frame_m, nearest_to_viewer_m);
  for (HandleThing& thing : things) {
    const glm::dvec3 way = thing.pose.position_m - drag.viewer_m;
    const double distance_m = glm::length(way);
    if (keep_size) {
      thing.pose.position_m = drag.viewer_m + all * way;
      if (thing.scales) thing.scale *= all;
    } else if (distance_m < 1e-9) {
      thing.pose.position_m += amount_m * drag.frame.axes[2];
    } else {
      thing.pose.position_m = drag.viewer_m + std::max(distance_m + amount_m, nearest_to_viewer_m) / distance_m * way;
    }
  }
}

Dragged moved(const HandleDrag& drag, const std::vector<double>& amounts_m, const DragWish& wish) {
  Dragged dragged{drag.things, ""};
  if (drag.frame.space == HandleSpace::sight && drag.handle == Handle::z) {
    move_along_sight(drag, amounts_m[0], wish.keep_angular_size, dragged.things);
    dragged.amount = signed_text(amounts_m[0], 3) + " m along the sight";
    return dragged;
  }
  const std::vector<glm::dvec3> axes = axes_of(drag);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    for (HandleThing& thing : dragged.things) thing.pose.position_m += amounts_m[i] * axes[i];
    dragged.amount += (i == 0 ? "" : ", ") + signed_text(amounts_m[i], 3);
  }
  dragged.amount += " m";
  return dragged;
}

Dragged turned(const HandleDrag& drag, double amount_deg) {
  Dragged dragged{drag.things, signed_text(amount_deg, 1) + "\u00b0"};
  const glm::dquat turn = glm::angleAxis(glm::radians(amount_deg), axis_of_turn(drag));
  for (HandleThing& thing : dragged.things) {
    thing.pose.position_m = drag.frame.origin_m + turn * (thing.pose.position_m - drag.frame.origin_m);
    if (thing.turns) thing.pose.rotation = glm::normalize(turn * thing.pose.rotation);
  }
  return dragged;
}

Dragged scaled(const HandleDrag& drag, double factor) {
  factor = std::clamp(factor, smallest_factor, largest_factor);
  Dragged dragged{drag.things, "\u00d7 " + fixed_text(factor, 3)};
  for (HandleThing& thing : dragged.things) {
    thing.pose.position_m = drag.frame.origin_m + factor * (thing.pose.position_m - drag.frame.origin_m);
    if (thing.scales) thing.scale *= factor;
  }
  return dragged;
}

}  // namespace

HandleDrag drag_start(HandleTool tool, Handle handle, const HandleFrame& frame, const RoomView& view,
                      const glm::dvec2& start_px, const Rigid& world_from_viewer, std::vector<HandleThing> things) {
  return {tool, handle, frame, view, start_px, world_from_viewer.position_m, std::move(things)};
}

Dragged drag_to(const HandleDrag& drag, const glm::dvec2& pixel, const DragWish& wish) {
  switch (drag.tool) {
    case HandleTool::move: {
      std::vector<double> amounts_m = moved_m(drag, pixel);
      if (wish.snap) snap_moves(drag, wish.snap_m, amounts_m);
      return moved(drag, amounts_m, wish);
    }
    case HandleTool::turn: {
      const double amount_deg = turned_deg(drag, pixel);
      return turned(drag, wish.snap ? snapped(amount_deg, 0.0, wish.snap_deg) : amount_deg);
    }
    case HandleTool::scale: {
      const double factor = scaled_by(drag, pixel);
      return scaled(drag, wish.snap ? std::max(snapped(factor, 0.0, wish.snap_factor), wish.snap_factor) : factor);
    }
    case HandleTool::measure:
      break;
  }
  return {drag.things, ""};
}

Dragged drag_by(const HandleDrag& drag, std::span<const double> numbers, const DragWish& wish) {
  const auto number = [&](std::size_t i, double otherwise) { return i < numbers.size() ? numbers[i] : otherwise; };
  switch (drag.tool) {
    case HandleTool::move:
      return moved(drag, {number(0, 0.0), number(1, 0.0)}, wish);
    case HandleTool::turn:
      return turned(drag, number(0, 0.0));
    case HandleTool::scale:
      return scaled(drag, number(0, 1.0));
    case HandleTool::measure:
      break;
  }
  return {drag.things, ""};
}

}  // namespace focalstage
