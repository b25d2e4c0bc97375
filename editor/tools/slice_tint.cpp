#include "editor/tools/slice_tint.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>

#include "core/optics/assignment.h"
#include "core/optics/vergence.h"
#include "core/percept/conflict.h"

namespace focalstage {
namespace {

constexpr Rgb no_surface{110, 112, 116};
constexpr int grid = 20;  // of looks at which the surface behind is asked for; between them it is interpolated

/// The axial distance of the surfaces over a box of looks; 0 where there is none.
struct SurfaceGrid {
  LookBox box;
  std::array<double, (grid + 1) * (grid + 1)> vergence_d{};

  double at(int x, int y) const { return vergence_d[static_cast<std::size_t>(y * (grid + 1) + x)]; }

  /// Bilinear among the corners that have a surface; 0 if none has.
  double behind_d(const glm::dvec2& look) const {
    const glm::dvec2 size = glm::max(box.high - box.low, glm::dvec2(1e-9));
    const glm::dvec2 place = glm::clamp((look - box.low) / size, 0.0, 1.0) * static_cast<double>(grid);
    const int x = std::min(static_cast<int>(place.x), grid - 1);
    const int y = std::min(static_cast<int>(place.y), grid - 1);
    const glm::dvec2 share = place - glm::dvec2(x, y);
    double sum = 0.0;
    double weights = 0.0;
    for (int corner = 0; corner < 4; ++corner) {
      const int right = corner & 1;
      const int up = corner >> 1;
      const double there_d = at(x + right, y + up);
      if (there_d <= 0.0) continue;
      const double weight = (right == 1 ? share.x : 1.0 - share.x) * (up == 1 ? share.y : 1.0 - share.y) + 1e-12;
      sum += weight * there_d;
      weights += weight;
    }
    return weights > 0.0 ? sum / weights : 0.0;
  }
};

SurfaceGrid surface_grid(const SightFrame& sight, const Stage& stage, const LookBox& box, Picker& picker) {
  SurfaceGrid surfaces{box};
  for (int y = 0; y <= grid; ++y) {
    for (int x = 0; x <= grid; ++x) {
      const glm::dvec2 look = box.low + (box.high - box.low) * glm::dvec2(x, y) / static_cast<double>(grid);
      const std::optional<PickHit> hit = picker.first_surface(stage, sight.ray_along(look));
      const double axial_m = hit ? sight.axial_m(hit->point_m) : 0.0;
      surfaces.vergence_d[static_cast<std::size_t>(y * (grid + 1) + x)] = axial_m > 0.0 ? 1.0 / axial_m : 0.0;
    }
  }
  return surfaces;
}

/// The power wanted by what stands at `axial_m` before a surface of `behind_d`.
double wanted_power_d(const Project& project, const Depth& depth, double axial_m, double behind_d) {
  if (depth.mode != DepthMode::slice) return behind_d - wanted_vergence_d(depth, axial_m);
  const auto last = static_cast<int>(project.slices.powers_d.size()) - 1;
  return project.slices.powers_d[static_cast<std::size_t>(std::clamp(depth.index, 0, last))];
}

constexpr glm::dvec3 no_slice(0.6);

}  // namespace

glm::dvec3 slice_colour(const std::vector<double>& powers_d, std::size_t slice) {
  constexpr std::array<glm::dvec3, 5> ramp{glm::dvec3(0.30, 0.56, 1.00), glm::dvec3(0.20, 0.76, 0.74),
                                           glm::dvec3(0.56, 0.82, 0.34), glm::dvec3(0.95, 0.76, 0.30),
                                           glm::dvec3(0.93, 0.42, 0.36)};
  if (slice >= powers_d.size()) return no_slice;  // what is still shown may be of a list that was longer
  const auto below =
      std::count_if(powers_d.begin(), powers_d.end(), [&](double power_d) { return power_d < powers_d[slice]; });
  const double place = powers_d.size() < 2 ? 0.0
                                           : static_cast<double>(below) * (static_cast<double>(ramp.size()) - 1.0) /
                                                 (static_cast<double>(powers_d.size()) - 1.0);
  const auto from = std::min(static_cast<std::size_t>(place), ramp.size() - 2);
  return glm::mix(ramp[from], ramp[from + 1], place - static_cast<double>(from));
}

namespace {

/// What the colour of a spot depends on.
struct TintSpot {
  double axial_m = 0.0;   ///< where it stands
  double behind_d = 0.0;  ///< 1 / distance of the surface behind it
  double wanted_d = 0.0;  ///< the power it wants
};

Rgb slices_colour(const SliceRule& rule, const std::vector<glm::dvec3>& palette, const TintSpot& spot) {
  glm::dvec3 colour(0.0);
  for (std::size_t n = 0; n < palette.size(); ++n) colour += rule.weight(n, spot.wanted_d) * palette[n];
  return Rgb(glm::clamp(colour, 0.0, 1.0) * 255.0 + 0.5);
}

/// The slices reach no further than the outermost; its picture lies 1/d_p - v away.
Rgb conflicting_colour(const SliceRule& rule, const TintSpot& spot) {
  const double given_d = std::clamp(spot.wanted_d, rule.lowest_d(), rule.highest_d());
  const auto colour = conflict_colour(1.0 / spot.axial_m - (spot.behind_d - given_d));
  constexpr double lightest = 110.0;  // so that shading still shows
  return Rgb(glm::min(glm::dvec3(colour[0], colour[1], colour[2]) + lightest, 255.0));
}

}  // namespace

std::vector<Rgb> object_tint(ObjectTint kind, const Project& project, const Stage& stage, const StagedObject& object,
                             const Drawable& drawable, Picker& picker) {
  const std::vector<glm::dvec3>& points = drawable.mesh->positions_m;
  std::vector<Rgb> colours(points.size(), no_surface);
  const std::vector<double>& powers_d = project.slices.powers_d;
  const SightFrame sight = sight_frame(project, stage);
  const LookBox box = looks_at(sight, {drawable});
  if (box.empty() || powers_d.empty() || kind == ObjectTint::none) return colours;
  const SurfaceGrid surfaces = surface_grid(sight, stage, box, picker);
  const SliceRule rule(powers_d, project.slices.assignment);
  std::vector<glm::dvec3> palette;
  for (std::size_t n = 0; n < powers_d.size(); ++n) palette.push_back(slice_colour(powers_d, n));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 point_m(drawable.world_from_mesh * glm::dvec4(points[i], 1.0));
    const std::optional<glm::dvec2> look = sight.look_at(point_m);
    TintSpot spot{sight.axial_m(point_m), look ? surfaces.behind_d(*look) : 0.0};
    if (spot.behind_d <= 0.0 || spot.axial_m <= 0.0) continue;
    spot.wanted_d = wanted_power_d(project, object.depth, spot.axial_m, spot.behind_d);
    colours[i] = kind == ObjectTint::slices ? slices_colour(rule, palette, spot) : conflicting_colour(rule, spot);
  }
  return colours;
}

}  // namespace focalstage
