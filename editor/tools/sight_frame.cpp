#include "editor/tools/sight_frame.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/mesh/measure.h"
#include "editor/tools/known_bounds.h"

namespace focalstage {
namespace {

constexpr double before_pupil_m = 1e-3;
constexpr std::size_t sampled_points = 96;
constexpr std::size_t sampled_triangles = 20'000;

glm::dvec3 placed(const Drawable& drawable, const glm::dvec3& mesh_m) {
  return glm::dvec3(drawable.world_from_mesh * glm::dvec4(mesh_m, 1.0));
}

}  // namespace

double SightFrame::axial_m(const glm::dvec3& world_m) const {
  return -world_from_viewer.inverse().point(world_m).z - lens_to_pupil_m;
}

std::optional<glm::dvec2> SightFrame::look_at(const glm::dvec3& world_m) const {
  const glm::dvec3 p = world_from_viewer.inverse().point(world_m);
  if (!(-p.z > before_pupil_m)) return std::nullopt;
  return glm::dvec2(p.x, p.y) / -p.z;
}

glm::dvec3 SightFrame::point_at(const glm::dvec2& look, double axial_m) const {
  return world_from_viewer.point((axial_m + lens_to_pupil_m) * glm::dvec3(look, -1.0));
}

Ray SightFrame::ray_along(const glm::dvec2& look) const {
  return {world_from_viewer.position_m, world_from_viewer.direction(glm::normalize(glm::dvec3(look, -1.0)))};
}

SightFrame sight_frame(const Project& project, const Stage& stage) {
  return {stage.world_from_viewer, project.glasses.lens_to_pupil_mm * 1e-3};
}

LookBox looks_at(const SightFrame& sight, const std::vector<Drawable>& drawables) {
  LookBox box;
  for (const Drawable& drawable : drawables) {
    const Bounds& bounds = known_bounds(drawable.mesh);
    if (bounds.empty()) continue;
    for (unsigned i = 0; i < 8; ++i) {
      const glm::dvec3 corner{(i & 1u) != 0 ? bounds.max_m.x : bounds.min_m.x,
                              (i & 2u) != 0 ? bounds.max_m.y : bounds.min_m.y,
                              (i & 4u) != 0 ? bounds.max_m.z : bounds.min_m.z};
      const std::optional<glm::dvec2> look = sight.look_at(placed(drawable, corner));
      if (!look) continue;
      box = box.empty() ? LookBox{*look, *look} : LookBox{glm::min(box.low, *look), glm::max(box.high, *look)};
    }
  }
  return box;
}

std::optional<double> surface_behind_m(const SightFrame& sight, const Stage& stage,
                                       const std::vector<Drawable>& drawables, Picker& picker) {
  double sum_m = 0.0;
  int count = 0;
  for (const Drawable& drawable : drawables) {
    const std::vector<glm::dvec3>& points = drawable.mesh->positions_m;
    const std::size_t step = std::max<std::size_t>(1, points.size() / sampled_points);
    for (std::size_t i = 0; i < points.size(); i += step) {
      const std::optional<glm::dvec2> look = sight.look_at(placed(drawable, points[i]));
      if (!look) continue;
      const std::optional<PickHit> hit = picker.first_surface(stage, sight.ray_along(*look));
      if (!hit || sight.axial_m(hit->point_m) <= 0.0) continue;
      sum_m += sight.axial_m(hit->point_m);
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return sum_m / count;
}

const StagedSurface* main_surface(const SightFrame& sight, const Stage& stage, Picker& picker) {
  if (stage.surfaces.empty()) return nullptr;
  const std::optional<PickHit> hit = picker.first_surface(stage, sight.ray_along({0.0, 0.0}));
  for (const StagedSurface& surface : stage.surfaces) {
    if (hit && surface.name == hit->thing.name) return &surface;
  }
  return &stage.surfaces.front();
}

std::optional<double> mean_axial_m(const SightFrame& sight, const StagedSurface& surface) {
  double area = 0.0;
  double sum = 0.0;
  for (const Drawable& drawable : surface.drawables) {
    const std::vector<glm::uvec3>& triangles = drawable.mesh->triangles;
    const std::size_t step = std::max<std::size_t>(1, triangles.size() / sampled_triangles);
    for (std::size_t i = 0; i < triangles.size(); i += step) {
      const std::vector<glm::dvec3>& p = drawable.mesh->positions_m;
      const glm::dvec3 a = placed(drawable, p[triangles[i].x]);
      const glm::dvec3 b = placed(drawable, p[triangles[i].y]);
      const glm::dvec3 c = placed(drawable, p[triangles[i].z]);
      const double axial_m = sight.axial_m((a + b + c) / 3.0);
      if (axial_m <= 0.0) continue;
      const double doubled = glm::length(doubled_area(a, b, c));
      area += doubled;
      sum += doubled * axial_m;
    }
  }
  if (area <= 0.0) return std::nullopt;
  return sum / area;
}

}  // namespace focalstage
