#pragma once

#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/scene/project.h"
#include "core/stage/stage.h"
#include "editor/tools/pick.h"
#include "editor/tools/room_view.h"

namespace focalstage {

/// The viewer as one eye between the two: what depth is told by where no eye is meant in particular. Distances are
/// axial, along the gaze from the lens centre, as everywhere in the optics (design section 5).
struct SightFrame {
  Rigid world_from_viewer;
  double lens_to_pupil_m = 0.015;

  /// Along the gaze from the lens centre; negative behind it.
  double axial_m(const glm::dvec3& world_m) const;
  /// Where a point is seen straight, as in core/optics/look.h; only for what lies before the pupils.
  std::optional<glm::dvec2> look_at(const glm::dvec3& world_m) const;
  /// The point in the direction of a look at that axial distance.
  glm::dvec3 point_at(const glm::dvec2& look, double axial_m) const;
  Ray ray_along(const glm::dvec2& look) const;
};

SightFrame sight_frame(const Project& project, const Stage& stage);

/// A range of looks.
struct LookBox {
  glm::dvec2 low{1.0};
  glm::dvec2 high{-1.0};

  bool empty() const { return low.x > high.x; }
  glm::dvec2 middle() const { return 0.5 * (low + high); }
};

/// The looks that meet drawables, by the corners of each one's own bounds; empty where all lie behind the viewer.
LookBox looks_at(const SightFrame& sight, const std::vector<Drawable>& drawables);

/// The mean axial distance of the real surfaces in the directions of some drawables; none where none is behind them.
std::optional<double> surface_behind_m(const SightFrame& sight, const Stage& stage,
                                       const std::vector<Drawable>& drawables, Picker& picker);

/// The surface that most of the picture is on: what the gaze meets, or the first of the stage. Null without any.
const StagedSurface* main_surface(const SightFrame& sight, const Stage& stage, Picker& picker);

/// The mean axial distance of a surface, by area over its triangles that lie before the viewer.
std::optional<double> mean_axial_m(const SightFrame& sight, const StagedSurface& surface);

}  // namespace focalstage
