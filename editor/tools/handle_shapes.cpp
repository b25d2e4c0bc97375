#include "editor/tools/handle_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

namespace focalstage {
namespace {

// Sizes in pixels at scale 1.
constexpr double arm_px = 78.0;
constexpr double arm_from_px = 14.0;
constexpr double head_px = 13.0;
constexpr double head_half_px = 5.5;
constexpr double plane_from_px = 24.0;
constexpr double plane_to_px = 40.0;
constexpr double centre_px = 6.5;
constexpr double ring_px = 72.0;
constexpr double view_ring_px = 86.0;
constexpr double box_half_px = 5.5;
constexpr double reach_px = 7.0;
constexpr int ring_points = 72;

constexpr std::array<Handle, 3> axis_handles{Handle::x, Handle::y, Handle::z};
constexpr std::array<Handle, 3> plane_handles{Handle::yz, Handle::zx, Handle::xy};

/// What all shapes of a frame are made from.
struct Drawing {
  const HandleFrame& frame;
  const RoomView& view;
  double scale;
  double per_px_m;  ///< metres of a (scaled) pixel at the frame's origin
  glm::dvec2 origin_px;
  glm::dvec3 to_camera;
  std::vector<HandleShape> shapes;

  std::optional<glm::dvec2> pixel(const glm::dvec3& from_origin_px) const {
    return pixel_of(view, frame.origin_m + per_px_m * from_origin_px);
  }
};

/// Fades what points at the camera: 0 within 8 degrees of it, 1 beyond 20.
double arm_opacity(const Drawing& drawing, const glm::dvec3& axis) {
  const double along = std::abs(glm::dot(axis, drawing.to_camera));
  return std::clamp((std::cos(0.14) - along) / (std::cos(0.14) - std::cos(0.35)), 0.0, 1.0);
}

/// Fades planes and rings seen from their edge.
double face_opacity(const Drawing& drawing, const glm::dvec3& normal) {
  return std::clamp((std::abs(glm::dot(normal, drawing.to_camera)) - 0.08) / 0.15, 0.0, 1.0);
}

std::vector<glm::dvec2> circle(const glm::dvec2& centre, double radius_px, int points) {
  std::vector<glm::dvec2> round;
  for (int i = 0; i < points; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / points;
    round.push_back(centre + radius_px * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  return round;
}

std::vector<glm::dvec2> square(const glm::dvec2& centre, double half_px) {
  return {centre + glm::dvec2(-half_px, -half_px), centre + glm::dvec2(half_px, -half_px),
          centre + glm::dvec2(half_px, half_px), centre + glm::dvec2(-half_px, half_px)};
}

/// A line from near the origin outwards and its end: an arrow's head, or a box for the tool that scales.
void add_arm(Drawing& drawing, std::size_t i, bool boxed) {
  const glm::dvec3& axis = drawing.frame.axes[i];
  const double opacity = arm_opacity(drawing, axis);
  const auto from = drawing.pixel(arm_from_px * axis);
  const auto tip = drawing.pixel(arm_px * axis);
  if (opacity <= 0.0 || !from || !tip) return;
  const glm::dvec2 way = *tip - *from;
  const double length_px = glm::length(way);
  if (length_px < 1e-6) return;
  const glm::dvec2 along = way / length_px;
  const glm::dvec2 across{-along.y, along.x};
  const double head = std::min(head_px * drawing.scale, 0.6 * length_px);
  const glm::dvec2 neck = *tip - head * along;
  drawing.shapes.push_back({axis_handles[i], {*from, neck}, false, false, opacity});
  const double half = head_half_px * drawing.scale;
  drawing.shapes.push_back({axis_handles[i],
                            boxed ? square(*tip, box_half_px * drawing.scale)
                                  : std::vector<glm::dvec2>{neck + half * across, *tip, neck - half * across},
                            true, true, opacity});
}

void add_plane(Drawing& drawing, std::size_t normal) {
  const double opacity = face_opacity(drawing, drawing.frame.axes[normal]);
  const glm::dvec3& a = drawing.frame.axes[(normal + 1) % 3];
  const glm::dvec3& b = drawing.frame.axes[(normal + 2) % 3];
  HandleShape shape{plane_handles[normal], {}, true, true, 0.75 * opacity};
  for (const auto& [p, q] : std::array<std::pair<double, double>, 4>{{{plane_from_px, plane_from_px},
                                                                      {plane_to_px, plane_from_px},
                                                                      {plane_to_px, plane_to_px},
                                                                      {plane_from_px, plane_to_px}}}) {
    const auto pixel = drawing.pixel(p * a + q * b);
    if (!pixel) return;
    shape.points_px.push_back(*pixel);
  }
  if (opacity > 0.0) drawing.shapes.push_back(std::move(shape));
}

/// The half of a ring that faces the camera, as one open line; the whole where it is seen from the front.
void add_ring(Drawing& drawing, std::size_t i) {
  const glm::dvec3& axis = drawing.frame.axes[i];
  glm::dvec3 start = glm::cross(axis, drawing.to_camera);  // where the near half begins
  const bool whole = glm::length(start) < 0.2;
  if (whole) start = drawing.frame.axes[(i + 1) % 3];
  start = glm::normalize(start);
  const glm::dvec3 other = glm::cross(start, axis);
  const double sign = glm::dot(other, drawing.to_camera) < 0.0 ? -1.0 : 1.0;
  HandleShape shape{axis_handles[i], {}, whole, false, 1.0};
  const int count = whole ? ring_points : ring_points / 2 + 1;
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / ring_points;
    const auto pixel = drawing.pixel(ring_px * (std::cos(angle) * start + sign * std::sin(angle) * other));
    if (!pixel) return;
    shape.points_px.push_back(*pixel);
  }
  drawing.shapes.push_back(std::move(shape));
}

void add_move(Drawing& drawing) {
  for (std::size_t i = 0; i < 3; ++i) add_plane(drawing, i);
  for (std::size_t i = 0; i < 3; ++i) add_arm(drawing, i, false);
  drawing.shapes.push_back({Handle::view, circle(drawing.origin_px, centre_px * drawing.scale, 24), true, true, 1.0});
}

void add_turn(Drawing& drawing) {
  drawing.shapes.push_back(
      {Handle::view, circle(drawing.origin_px, view_ring_px * drawing.scale, ring_points), true, false, 0.6});
  for (std::size_t i = 0; i < 3; ++i) add_ring(drawing, i);
}

void add_scale(Drawing& drawing) {
  for (std::size_t i = 0; i < 3; ++i) add_arm(drawing, i, true);
  drawing.shapes.push_back({Handle::view, square(drawing.origin_px, 1.2 * centre_px * drawing.scale), true, true, 1.0});
}

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 ab = b - a;
  const double squared = glm::dot(ab, ab);
  const double share = squared > 0.0 ? std::clamp(glm::dot(p - a, ab) / squared, 0.0, 1.0) : 0.0;
  return glm::length(p - (a + share * ab));
}

bool inside_polygon(const glm::dvec2& p, const std::vector<glm::dvec2>& points) {
  bool inside = false;
  for (std::size_t i = 0, j = points.size() - 1; i < points.size(); j = i++) {
    const glm::dvec2& a = points[i];
    const glm::dvec2& b = points[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
  }
  return inside;
}

double distance_to(const HandleShape& shape, const glm::dvec2& pixel) {
  if (shape.filled && inside_polygon(pixel, shape.points_px)) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  const std::size_t count = shape.points_px.size();
  for (std::size_t i = 0; i + 1 < count; ++i) {
    nearest = std::min(nearest, distance_to_segment(pixel, shape.points_px[i], shape.points_px[i + 1]));
  }
  if (shape.closed && count > 2) {
    nearest = std::min(nearest, distance_to_segment(pixel, shape.points_px.back(), shape.points_px.front()));
  }
  return nearest;
}

}  // namespace

std::optional<std::size_t> axis_of(Handle handle) {
  switch (handle) {
    case Handle::x:
    case Handle::yz:
      return 0;
    case Handle::y:
    case Handle::zx:
      return 1;
    case Handle::z:
    case Handle::xy:
      return 2;
    case Handle::view:
      break;
  }
  return std::nullopt;
}

bool is_plane(Handle handle) { return handle == Handle::yz || handle == Handle::zx || handle == Handle::xy; }

std::vector<HandleShape> handle_shapes(HandleTool tool, const HandleFrame& frame, const RoomView& view, double scale) {
  const auto origin_px = pixel_of(view, frame.origin_m);
  if (!origin_px) return {};
  Drawing drawing{frame,      view,
                  scale,      scale * metres_per_px(view, frame.origin_m),
                  *origin_px, glm::normalize(view.world_from_camera.position_m - frame.origin_m),
                  {}};
  switch (tool) {
    case HandleTool::move:
      add_move(drawing);
      break;
    case HandleTool::turn:
      add_turn(drawing);
      break;
    case HandleTool::scale:
      add_scale(drawing);
      break;
    case HandleTool::measure:
      break;
  }
  return std::move(drawing.shapes);
}

std::optional<Handle> handle_at(const std::vector<HandleShape>& shapes, const glm::dvec2& pixel, double scale) {
  std::optional<Handle> found;
  double nearest = reach_px * scale;
  for (const HandleShape& shape : shapes) {
    const double distance_px = distance_to(shape, pixel);
    if (distance_px > nearest) continue;
    nearest = distance_px;
    found = shape.handle;
  }
  return found;
}

}  // namespace focalstage
