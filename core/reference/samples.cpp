#include "core/reference/samples.h"

#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/optics/look.h"
#include "core/optics/vergence.h"
#include "core/reference/colour.h"

namespace focalstage {
namespace {

constexpr double near_plane_m = 1e-3;     ///< nothing nearer to the lens centre is seen
constexpr double hidden_by_share = 1e-4;  ///< a surface hides a point that lies this much deeper along the same line

}  // namespace

Samples::Samples(const Stage& stage, const CompileSettings& settings, View from_projector)
    : stage_(&stage),
      settings_(&settings),
      rule_(settings.slices.powers_d, settings.slices.assignment),
      eyes_(eyes_of(stage.world_from_viewer, stage.interpupillary_m, settings.lens_to_pupil_m)),
      from_projector_(std::move(from_projector)) {}

Result<Samples> Samples::of(const Stage& stage, const CompileSettings& settings) {
  Result<View> lit = view_of(stage.surfaces, settings.projector.world_from_projector.inverse(), nearest_lit_m);
  if (!lit) return lit.fault();
  Samples samples(stage, settings, *std::move(lit));
  const double nearest_m = settings.lens_to_pupil_m + near_plane_m;
  for (const Side side : both_sides) {
    const Rigid& eye_from_world = samples.eyes_[side].eye_from_world;
    Result<View> surfaces = view_of(stage.surfaces, eye_from_world, nearest_m);
    if (!surfaces) return surfaces.fault();
    Result<View> objects = view_of(stage.objects, eye_from_world, nearest_m);
    if (!objects) return objects.fault();
    samples.surfaces_.push_back(*std::move(surfaces));
    samples.objects_.push_back(*std::move(objects));
    if (settings.slices.breathing == Breathing::planar) {
      samples.part_depths_m_[side] = part_depths_m(stage.surfaces, eye_from_world);
    }
  }
  return samples;
}

std::optional<LitPoint> Samples::lit(const glm::dvec2& pixel) const {
  const glm::dvec2 tangent = tangent_of_pixel(settings_->projector, pixel);
  const std::optional<Sighting> met = from_projector_.sight.nearest(tangent);
  if (!met) return std::nullopt;
  const glm::dvec3 point_m = glm::dvec3(tangent, -1.0) * met->depth_m;
  return LitPoint{settings_->projector.world_from_projector.point(point_m), met->depth_m, met->triangle,
                  from_projector_.faces[met->triangle].thing, met->shares};
}

glm::dvec3 Samples::albedo(const LitPoint& lit) const {
  const Face& face = from_projector_.faces[lit.face];
  const Drawable& drawable = stage_->surfaces[face.thing].drawables[face.drawable];
  return glm::clamp(colour_at(drawable, face.triangle, lit.shares, glm::dvec3(0.0), {}), 0.0, 1.0);
}

double Samples::footprint_m2(const glm::dvec2& pixel, const LitPoint& lit) const {
  constexpr double step_px = 1e-2;
  const ProjectorModel& projector = settings_->projector;
  const glm::dvec3 normal = from_projector_.normal(lit.face);
  const double away_m = glm::dot(normal, from_projector_.corners_m[lit.face][0]);
  const glm::dvec2 place = place_of_pixel(projector, pixel);
  const auto on_plane = [&](const glm::dvec2& aside) {
    const glm::dvec3 ray(tangent_of_place(projector, place + aside), -1.0);
    return ray * (away_m / glm::dot(normal, ray));
  };
  const glm::dvec3 across = on_plane({step_px, 0.0}) - on_plane({-step_px, 0.0});
  const glm::dvec3 down = on_plane({0.0, step_px}) - on_plane({0.0, -step_px});
  return glm::length(glm::cross(across, down)) / (4.0 * step_px * step_px);
}

std::optional<EyePoint> Samples::seen(Side side, const LitPoint& lit) const {
  const View& view = surfaces_[index_of(side)];
  const double lens_to_pupil_m = settings_->lens_to_pupil_m;
  EyePoint eye;
  eye.point_m = eyes_[side].eye_from_world.point(lit.world_m);
  if (-eye.point_m.z < lens_to_pupil_m + near_plane_m) return std::nullopt;
  eye.normal = view.normal(lit.face);
  eye.straight = straight_look(eye.point_m);
  const bool planar = settings_->slices.breathing == Breathing::planar;
  eye.surface_m = (planar ? part_depths_m_[side][lit.face] : -eye.point_m.z) - lens_to_pupil_m;
  const std::optional<Sighting> first = view.sight.nearest(eye.straight);
  const bool hidden = first && first->depth_m < -eye.point_m.z * (1.0 - hidden_by_share);
  if (hidden) return std::nullopt;
  return eye;
}

/// The look from the pupil in which slice `n` shows the point; none where the lens turns it behind the eye.
std::optional<glm::dvec2> Samples::look(const EyePoint& eye, std::size_t n) const {
  if (settings_->slices.breathing == Breathing::off) return eye.straight;
  const double stretch = look_stretch(settings_->slices.powers_d[n], eye.surface_m, settings_->lens_to_pupil_m);
  if (!(stretch > 0.0) || !std::isfinite(stretch)) return std::nullopt;
  return eye.straight * stretch;
}

std::optional<SliceSample> Samples::slice(Side side, const EyePoint& eye, std::size_t n) const {
  const std::optional<glm::dvec2> towards = look(eye, n);
  if (!towards) return std::nullopt;
  const View& view = objects_[index_of(side)];
  const auto solid = [&](const Sighting& seen) {
    const Face& hit = view.faces[seen.triangle];
    return !cut_away(stage_->objects[hit.thing].drawables[hit.drawable], hit.triangle, seen.shares);
  };
  const std::optional<Sighting> met = view.sight.nearest(*towards, solid);
  if (!met) return std::nullopt;

  const Face& face = view.faces[met->triangle];
  const StagedObject& object = stage_->objects[face.thing];
  const double lens_to_pupil_m = settings_->lens_to_pupil_m;
  SliceSample sample{*towards, face.thing, 0.0, 0.0, glm::dvec3(0.0)};
  if (object.depth.mode == DepthMode::slice) {
    const auto pinned = static_cast<std::size_t>(object.depth.index);
    sample.weight = pinned == n ? 1.0 : 0.0;
    sample.wanted_d = settings_->slices.powers_d[pinned];
  } else {
    const double plane_m = plane_distance_m(*towards, eye.point_m, eye.normal, lens_to_pupil_m);
    const double wanted_d = 1.0 / plane_m - wanted_vergence_d(object.depth, met->depth_m - lens_to_pupil_m);
    sample.wanted_d = wanted_d;
    sample.weight = rule_.weight(n, wanted_d);
    sample.beyond_d = rule_.beyond_d(wanted_d);
    sample.below = rule_.is_below(wanted_d);
  }
  const glm::dvec3 pupil_m = eyes_[side].eye_from_world.inverse().position_m;
  sample.colour = colour_at(object.drawables[face.drawable], face.triangle, met->shares, pupil_m, stage_->lights);
  return sample;
}

}  // namespace focalstage
