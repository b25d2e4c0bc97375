#include "core/calibrate/verify_picture.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace focalstage {

namespace {

constexpr double step_px = 0.5;
constexpr double nearest_m = 0.01;  // what is nearer to the projector's plane is not drawn
constexpr double half_width_px = 1.0;
constexpr int most_steps = 20000;

/// The part of an edge before the projector, in its own space.
std::optional<WorldEdge> before(const ProjectorModel& model, const WorldEdge& edge) {
  const Rigid own_from_world = model.world_from_projector.inverse();
  glm::dvec3 a = own_from_world.point(edge.first);
  glm::dvec3 b = own_from_world.point(edge.second);
  if (a.z > -nearest_m && b.z > -nearest_m) return std::nullopt;
  if (a.z > -nearest_m) a = glm::mix(b, a, (-nearest_m - b.z) / (a.z - b.z));
  if (b.z > -nearest_m) b = glm::mix(a, b, (-nearest_m - a.z) / (b.z - a.z));
  return WorldEdge(a, b);
}

class Drawing {
 public:
  explicit Drawing(const ProjectorModel& model)
      : model_(model), codes_(static_cast<std::size_t>(model.width_px) * static_cast<std::size_t>(model.height_px)) {}

  glm::dvec2 pixel(const glm::dvec3& own) const { return pixel_of_tangent(model_, glm::dvec2(own) / -own.z); }

  /// A tangent so far outside the picture that the lens' formula says nothing there.
  bool near_picture(const glm::dvec3& own) const {
    const glm::dvec2 straight = glm::dvec2(own.x, -own.y) / -own.z * model_.focal_px + model_.centre_px;
    const glm::dvec2 size(model_.width_px, model_.height_px);
    return straight.x > -size.x && straight.y > -size.y && straight.x < 2.0 * size.x && straight.y < 2.0 * size.y;
  }

  /// A dot whose light falls off over a pixel.
  void dot(const glm::dvec2& at) {
    for (int y = static_cast<int>(std::floor(at.y - half_width_px)); y <= at.y + half_width_px; ++y) {
      for (int x = static_cast<int>(std::floor(at.x - half_width_px)); x <= at.x + half_width_px; ++x) {
        if (x < 0 || y < 0 || x >= model_.width_px || y >= model_.height_px) continue;
        const double share = 1.0 - glm::distance(at, glm::dvec2(x + 0.5, y + 0.5)) / half_width_px;
        const auto code = static_cast<std::uint8_t>(std::clamp(std::lround(510.0 * share), 0L, 255L));
        std::uint8_t& there = codes_[static_cast<std::size_t>(y) * static_cast<std::size_t>(model_.width_px) +
                                     static_cast<std::size_t>(x)];
        there = std::max(there, code);
      }
    }
  }

  std::vector<std::uint8_t> codes() && { return std::move(codes_); }

 private:
  const ProjectorModel& model_;
  std::vector<std::uint8_t> codes_;
};

}  // namespace

std::vector<std::uint8_t> verify_picture(const ProjectorModel& model, const std::vector<WorldEdge>& edges,
                                         const std::function<bool(const glm::dvec3& world_m)>& seen) {
  Drawing drawing(model);
  for (const WorldEdge& edge : edges) {
    const auto part = before(model, edge);
    if (!part) continue;
    const auto& [a, b] = *part;
    // Equal steps along the picture: evenly spaced in one over the depth.
    const double length_px =
        glm::distance(glm::dvec2(a) / -a.z, glm::dvec2(b) / -b.z) * std::max(model.focal_px.x, model.focal_px.y);
    const int steps = std::clamp(static_cast<int>(std::ceil(length_px / step_px)), 1, most_steps);
    for (int i = 0; i <= steps; ++i) {
      const double along = static_cast<double>(i) / steps;
      const double share = along / b.z / ((1.0 - along) / a.z + along / b.z);
      const glm::dvec3 own = glm::mix(a, b, share);
      if (!drawing.near_picture(own)) continue;
      if (seen(model.world_from_projector.point(own))) drawing.dot(drawing.pixel(own));
    }
  }
  return std::move(drawing).codes();
}

}  // namespace focalstage
