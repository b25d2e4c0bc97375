#include "tests/exact/forward_trace.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

namespace focalstage::exact::forward {
namespace {

constexpr double nearest_m = 1e-3;  ///< from the lens: nothing nearer is seen

glm::dvec3 point(const glm::dmat4& to_from, const glm::dvec3& p) { return glm::dvec3(to_from * glm::dvec4(p, 1.0)); }
glm::dvec3 axis(const glm::dmat4& to_from, int i) { return glm::dvec3(to_from[i]); }

/// An eye behind its lens, in the world.
struct EyeFrame {
  glm::dvec3 pupil_m, right, up, gaze, lens_m;

  EyeFrame(const Room& room, int eye)
      : pupil_m(point(room.world_from_viewer, {room.interpupillary_m * (eye == 0 ? -0.5 : 0.5), 0.0, 0.0})),
        right(axis(room.world_from_viewer, 0)),
        up(axis(room.world_from_viewer, 1)),
        gaze(-axis(room.world_from_viewer, 2)),
        lens_m(pupil_m + gaze * room.lens_to_pupil_m) {}

  glm::dvec2 aside(const glm::dvec3& from_m, const glm::dvec3& to_m) const {
    return {glm::dot(to_m - from_m, right), glm::dot(to_m - from_m, up)};
  }
};

/// Undoes a projector's distortion: the position is corrected by what is missing until nothing is.
glm::dvec2 straightened(const std::vector<double>& k, const glm::dvec2& bent) {
  const auto c = [&](std::size_t i) { return i < k.size() ? k[i] : 0.0; };
  glm::dvec2 p = bent;
  for (int round = 0; round < 500; ++round) {
    const double r2 = p.x * p.x + p.y * p.y, r4 = r2 * r2, r6 = r4 * r2;
    const double radial = (1 + c(0) * r2 + c(1) * r4 + c(4) * r6) / (1 + c(5) * r2 + c(6) * r4 + c(7) * r6);
    const glm::dvec2 aside{2 * c(2) * p.x * p.y + c(3) * (r2 + 2 * p.x * p.x),
                           c(2) * (r2 + 2 * p.y * p.y) + 2 * c(3) * p.x * p.y};
    const glm::dvec2 missing = bent - (p * radial + aside);
    p += missing * 0.7;  // damped: the distortion stretches by less than two
    if (std::abs(missing.x) + std::abs(missing.y) < 1e-14) break;
  }
  return p;
}

/// Where a ray that leaves `spot` for the lens at `height` crosses the plane of the pupil. Thin lens: at the height h
/// its slope changes by -h times the power.
struct Bent {
  glm::dvec2 slope;  ///< behind the lens, towards the eye
  glm::dvec2 at_pupil;
};

Bent bent(const glm::dvec2& spot, double surface_m, const glm::dvec2& height, double power_d, double lens_to_pupil_m) {
  const glm::dvec2 arriving = (height - spot) / surface_m;
  const glm::dvec2 leaving = arriving - power_d * height;
  return {leaving, height + lens_to_pupil_m * leaving};
}

/// The one ray from the spot that the lens sends through the pupil's centre: where the crossing depends linearly on the
/// height at the lens, two rays find it.
glm::dvec2 arriving_slope(const glm::dvec2& spot, double surface_m, double power_d, double lens_to_pupil_m) {
  const Bent low = bent(spot, surface_m, {0.0, 0.0}, power_d, lens_to_pupil_m);
  const Bent high = bent(spot, surface_m, {1e-3, 1e-3}, power_d, lens_to_pupil_m);
  const glm::dvec2 per_height = (high.at_pupil - low.at_pupil) / 1e-3;
  return bent(spot, surface_m, -low.at_pupil / per_height, power_d, lens_to_pupil_m).slope;
}

/// Share of light that a slice carries of what wants `wanted_d`, counted along the sorted powers.
double share(const std::vector<double>& powers_d, std::size_t slice, double wanted_d, bool nearest_rule) {
  std::vector<double> sorted = powers_d;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  const double own = powers_d[slice];
  if (std::find(powers_d.begin(), powers_d.begin() + static_cast<std::ptrdiff_t>(slice), own) !=
      powers_d.begin() + static_cast<std::ptrdiff_t>(slice)) {
    return 0.0;  // an earlier slice of the same power has it all
  }
  const double wanted = std::clamp(wanted_d, sorted.front(), sorted.back());
  const auto above = std::lower_bound(sorted.begin(), sorted.end(), wanted);
  const double high = *above, low = above == sorted.begin() ? high : *(above - 1);
  const double high_share = high == low ? 1.0 : (wanted - low) / (high - low);
  const double rounded = nearest_rule ? (high_share > 0.5 ? 1.0 : 0.0) : high_share;
  if (own == high) return high == low ? 1.0 : rounded;
  return own == low ? 1.0 - rounded : 0.0;
}

double paint(const Painted& painted, const glm::dvec2& uv) {
  const auto column = static_cast<long>(std::floor(uv.x * painted.squares.x));
  const auto row = static_cast<long>(std::floor(uv.y * painted.squares.y));
  return (column + row) % 2 == 0 ? painted.first : painted.second;
}

/// Share of the light at the far end of a look that belongs to the slice. `spot_m` lies on the surface.
double share_of(const Room& room, const EyeFrame& eye, const Painted& painted, std::size_t slice,
                const glm::dvec3& direction, double object_m, const Triangle& surface, const glm::dvec3& spot_m) {
  if (painted.focus == Painted::Focus::slice) return static_cast<std::size_t>(painted.slice) == slice ? 1.0 : 0.0;
  const glm::dvec3 normal =
      glm::cross(surface.corner_m[1] - surface.corner_m[0], surface.corner_m[2] - surface.corner_m[0]);
  const double met = glm::dot(normal, spot_m - eye.pupil_m) / glm::dot(normal, direction) - room.lens_to_pupil_m;
  const double own = glm::dot(spot_m - eye.lens_m, eye.gaze);
  const double surface_m = std::isfinite(met) && met > 0.0 ? met : own;
  double wanted_vergence_d = painted.vergence_d;
  if (painted.focus == Painted::Focus::placed) wanted_vergence_d = 1.0 / object_m;
  if (painted.focus == Painted::Focus::offset) wanted_vergence_d += 1.0 / object_m;
  return share(room.powers_d, slice, 1.0 / surface_m - wanted_vergence_d, room.nearest_rule);
}

bool alike(double code, double expected) { return std::abs(code - expected) <= 1.5; }

}  // namespace

Arrival trace(const Room& room, int eye_index, std::size_t slice, const glm::dvec2& place) {
  const EyeFrame eye(room, eye_index);
  Arrival arrival;
  const glm::dvec2 image = straightened(room.distortion, (place - room.centre_px) / room.focal_px);
  const glm::dvec3 projector_m = point(room.world_from_projector, glm::dvec3(0.0));
  const glm::dvec3 out = axis(room.world_from_projector, 0) * image.x - axis(room.world_from_projector, 1) * image.y -
                         axis(room.world_from_projector, 2);
  const std::optional<Meeting> lit = room.surfaces.first(projector_m, out, 0.0);
  if (!lit) return arrival;
  arrival.triangle = lit->triangle;
  const glm::dvec3 spot_m = projector_m + out * lit->along;
  const double surface_m = glm::dot(spot_m - eye.lens_m, eye.gaze);
  if (surface_m < nearest_m) return arrival;
  const glm::dvec3 straight = (spot_m - eye.pupil_m) / (surface_m + room.lens_to_pupil_m);
  const std::optional<Meeting> before = room.surfaces.first(eye.pupil_m, straight, room.lens_to_pupil_m + nearest_m);
  if (before && before->along < (surface_m + room.lens_to_pupil_m) * (1.0 - 1e-4)) return arrival;

  arrival.arrives = true;
  arrival.slope = -arriving_slope(eye.aside(eye.lens_m, spot_m), surface_m, room.powers_d[slice], room.lens_to_pupil_m);
  const glm::dvec3 direction = eye.gaze + eye.right * arrival.slope.x + eye.up * arrival.slope.y;
  const std::optional<Meeting> met = room.objects.first(eye.pupil_m, direction, room.lens_to_pupil_m + nearest_m);
  if (!met) return arrival;
  const Painted& painted = room.painted[room.objects.triangle(met->triangle).owner];
  const double light =
      paint(painted, met->uv) * share_of(room, eye, painted, slice, direction, met->along - room.lens_to_pupil_m,
                                         room.surfaces.triangle(lit->triangle), spot_m);
  if (light > 0.0) {
    arrival.code = (std::exp2(room.bits) - 1.0) * std::pow(std::min(1.0, light), 1.0 / room.gamma);
  }
  return arrival;
}

EdgeReport check_edges(const Room& room, const Picture& picture, double tolerance_px, std::uint64_t enough) {
  EdgeReport report;
  const auto width = static_cast<std::size_t>(room.width_px);
  for (std::size_t i = 0; i < picture.codes.size() && report.contradicted < enough; ++i) {
    const std::size_t x = i % width, y = i / width;
    const double code = picture.codes[i];
    ++report.pixels;
    if (x + 1 < width && !alike(code, picture.codes[i + 1])) ++report.edges;
    const double aside = room.diamond && y % 2 == 1 ? 0.5 : 0.0;
    const glm::dvec2 centre{static_cast<double>(x) + 0.5 + aside, static_cast<double>(y) + 0.5};
    if (alike(code, trace(room, picture.eye, picture.slice, centre).code)) continue;
    double found_px = 0.0;
    for (const double share_of_tolerance : {0.02, 0.1, 0.3, 1.0}) {
      for (int turn = 0; turn < 16 && found_px == 0.0; ++turn) {
        const double angle = turn * std::numbers::pi / 8.0, radius_px = share_of_tolerance * tolerance_px;
        const glm::dvec2 beside = centre + radius_px * glm::dvec2(std::cos(angle), std::sin(angle));
        if (alike(code, trace(room, picture.eye, picture.slice, beside).code)) found_px = radius_px;
      }
    }
    ++(found_px > 0.0 ? report.displaced : report.contradicted);
    report.worst_px = std::max(report.worst_px, found_px > 0.0 ? found_px : 2.0 * tolerance_px);
  }
  return report;
}

EdgeReport& EdgeReport::operator+=(const EdgeReport& other) {
  pixels += other.pixels;
  edges += other.edges;
  displaced += other.displaced;
  contradicted += other.contradicted;
  worst_px = std::max(worst_px, other.worst_px);
  return *this;
}

double EdgeReport::mean_px() const {
  return edges == 0 ? 0.0 : static_cast<double>(displaced + contradicted) / static_cast<double>(edges);
}

}  // namespace focalstage::exact::forward
