#include "core/mesh/implicit.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/mesh/circle.h"

namespace focalstage {
namespace {

constexpr double nearly_zero = 1e-12;

/// Columns are the images of the axes; `side` -1 mirrors in x = 0.
glm::dmat3 world_from_ellipsoid(const glm::dvec2& tilt_deg, double side) {
  const SinCos x = sin_cos_deg(tilt_deg.x);
  const SinCos z = sin_cos_deg(side * tilt_deg.y);
  const glm::dmat3 about_x(1, 0, 0, 0, x.cos, x.sin, 0, -x.sin, x.cos);
  const glm::dmat3 about_z(z.cos, z.sin, 0, -z.sin, z.cos, 0, 0, 0, 1);
  return about_z * about_x;
}

/// The smaller of a and b, rounded where they differ by less than `blend`: twice continuously differentiable.
/// `share` gets how much of the slope is b's.
double smooth_min(double a, double b, double blend, double& share) {
  const double lead = std::max(blend - std::abs(a - b), 0.0) / (blend > 0.0 ? blend : 1.0);
  const double half = 0.5 * lead * lead;
  share = a < b ? half : 1.0 - half;
  return std::min(a, b) - lead * lead * lead * blend / 6.0;
}

}  // namespace

BlendedSolid::BlendedSolid(const std::vector<Ellipsoid>& ellipsoids) {
  for (const Ellipsoid& ellipsoid : ellipsoids) {
    add(ellipsoid, 1.0);
    if (ellipsoid.mirrored) add(ellipsoid, -1.0);
  }
}

void BlendedSolid::add(const Ellipsoid& ellipsoid, double side) {
  const glm::dvec3 centre_m = ellipsoid.centre_m * glm::dvec3(side, 1.0, 1.0);
  const glm::dvec3 inverse = 1.0 / ellipsoid.radius_m;
  glm::dmat3 unit_from_world = glm::transpose(world_from_ellipsoid(ellipsoid.tilt_deg, side));
  for (int column = 0; column < 3; ++column) unit_from_world[column] *= inverse;
  parts_.push_back({centre_m, unit_from_world, inverse, ellipsoid.blend_m, ellipsoid.hollow ? -1.0 : 1.0});
}

// An ellipsoid's field is k (k - 1) / |grad k| with k(p) the length of p in the space where it is the unit sphere:
// exact on the surface to first order, a good estimate of the distance around it.
double BlendedSolid::value(const glm::dvec3& point_m) const {
  double total = 1.0;
  double share;
  for (const Part& part : parts_) {
    const glm::dvec3 unit = part.unit_from_world * (point_m - part.centre_m);
    const glm::dvec3 steep = unit * part.inverse_radius;
    const double k2 = glm::dot(unit, unit);
    const double slope = std::sqrt(glm::dot(steep, steep)) + nearly_zero;
    const double value = (k2 - std::sqrt(k2)) / slope;
    total = part.sign * smooth_min(part.sign * total, value, part.blend_m, share);
  }
  return total;
}

FieldValue BlendedSolid::value_and_gradient(const glm::dvec3& point_m) const {
  FieldValue total{1.0, glm::dvec3(0.0)};
  for (const Part& part : parts_) {
    const glm::dvec3 unit = part.unit_from_world * (point_m - part.centre_m);
    const glm::dvec3 steep = unit * part.inverse_radius;
    const double k2 = glm::dot(unit, unit);
    const double k = std::sqrt(k2);
    const double slope = std::sqrt(glm::dot(steep, steep)) + nearly_zero;
    const double value = (k2 - k) / slope;
    // d(k^2 - k) = (2 - 1/k) unit, d slope = steep / (radius slope), both in unit space.
    const glm::dvec3 in_unit =
        ((2.0 - 1.0 / (k + nearly_zero)) * unit - value / slope * steep * part.inverse_radius) / slope;
    const glm::dvec3 gradient = in_unit * part.unit_from_world;
    double share;
    total.value = part.sign * smooth_min(part.sign * total.value, value, part.blend_m, share);
    total.gradient = (1.0 - share) * total.gradient + share * part.sign * gradient;
  }
  return total;
}

}  // namespace focalstage
