#include "core/optics/projector_model.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

namespace focalstage {
namespace {

double coefficient(const std::vector<double>& distortion, std::size_t i) {
  return i < distortion.size() ? distortion[i] : 0.0;
}

/// OpenCV's model in image axes (x right, y down): radial k1 k2 k3 over k4 k5 k6, tangential p1 p2.
glm::dvec2 distorted(const std::vector<double>& c, const glm::dvec2& p) {
  const double r2 = glm::dot(p, p);
  const double above = 1.0 + r2 * (coefficient(c, 0) + r2 * (coefficient(c, 1) + r2 * coefficient(c, 4)));
  const double below = 1.0 + r2 * (coefficient(c, 5) + r2 * (coefficient(c, 6) + r2 * coefficient(c, 7)));
  const double p1 = coefficient(c, 2);
  const double p2 = coefficient(c, 3);
  const glm::dvec2 tangential{2.0 * p1 * p.x * p.y + p2 * (r2 + 2.0 * p.x * p.x),
                              p1 * (r2 + 2.0 * p.y * p.y) + 2.0 * p2 * p.x * p.y};
  return p * (above / below) + tangential;
}

glm::dmat2 slope(const std::vector<double>& c, const glm::dvec2& p) {
  constexpr double h = 1e-6;
  const glm::dvec2 dx = (distorted(c, p + glm::dvec2(h, 0)) - distorted(c, p - glm::dvec2(h, 0))) / (2.0 * h);
  const glm::dvec2 dy = (distorted(c, p + glm::dvec2(0, h)) - distorted(c, p - glm::dvec2(0, h))) / (2.0 * h);
  return {dx, dy};
}

glm::dvec2 undistorted(const std::vector<double>& c, const glm::dvec2& wanted) {
  glm::dvec2 p = wanted;
  for (int step = 0; step < 50; ++step) {
    const glm::dvec2 miss = distorted(c, p) - wanted;
    if (glm::dot(miss, miss) < 1e-24) break;
    const glm::dmat2 j = slope(c, p);
    const glm::dvec2 next = p - glm::inverse(j) * miss;
    if (!std::isfinite(next.x) || !std::isfinite(next.y)) break;
    p = next;
  }
  return p;
}

/// By how much the row that holds `y` is shifted, in columns. Also for rows far outside the picture.
double row_shift(const ProjectorModel& model, double y) {
  if (model.layout == PixelLayout::square) return 0.0;
  const double half = 0.5 * std::floor(y);
  return half == std::floor(half) ? 0.0 : 0.5;
}

}  // namespace

ProjectorModel projector_model(const Projector& projector) {
  return {projector.width_px,
          projector.height_px,
          {projector.fx_px, projector.fy_px},
          {projector.cx_px, projector.cy_px},
          projector.distortion,
          projector.pose,
          projector.pixel_layout};
}

ProjectorModel resized(const ProjectorModel& model, int width_px, int height_px) {
  const glm::dvec2 ratio{static_cast<double>(width_px) / model.width_px,
                         static_cast<double>(height_px) / model.height_px};
  ProjectorModel small = model;
  small.width_px = width_px;
  small.height_px = height_px;
  small.focal_px *= ratio;
  small.centre_px *= ratio;
  small.layout = PixelLayout::square;
  return small;
}

glm::dvec2 place_of_pixel(const ProjectorModel& model, const glm::dvec2& pixel) {
  return {pixel.x + row_shift(model, pixel.y), pixel.y};
}

glm::dvec2 pixel_of_place(const ProjectorModel& model, const glm::dvec2& place) {
  return {place.x - row_shift(model, place.y), place.y};
}

glm::dvec2 tangent_of_place(const ProjectorModel& model, const glm::dvec2& place) {
  glm::dvec2 image = (place - model.centre_px) / model.focal_px;
  if (!model.distortion.empty()) image = undistorted(model.distortion, image);
  return {image.x, -image.y};  // image rows run down, +Y is up
}

glm::dvec2 place_of_tangent(const ProjectorModel& model, const glm::dvec2& tangent) {
  glm::dvec2 image{tangent.x, -tangent.y};
  if (!model.distortion.empty()) image = distorted(model.distortion, image);
  return image * model.focal_px + model.centre_px;
}

glm::dvec2 tangent_of_pixel(const ProjectorModel& model, const glm::dvec2& pixel) {
  return tangent_of_place(model, place_of_pixel(model, pixel));
}

glm::dvec2 pixel_of_tangent(const ProjectorModel& model, const glm::dvec2& tangent) {
  return pixel_of_place(model, place_of_tangent(model, tangent));
}

std::optional<glm::dvec2> pixel_of_world(const ProjectorModel& model, const glm::dvec3& world_m) {
  constexpr double nearest_m = 1e-6;
  const glm::dvec3 p = model.world_from_projector.inverse().point(world_m);
  if (!(p.z < -nearest_m)) return std::nullopt;
  return pixel_of_tangent(model, glm::dvec2(p) / -p.z);
}

}  // namespace focalstage
