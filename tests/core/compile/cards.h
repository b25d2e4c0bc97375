#pragma once

#include <vector>

#include "core/compile/frame.h"
#include "core/stage/stage.h"
#include "tests/support/shapes.h"

namespace focalstage::cards {

/// A small projector straight behind the viewer's head, 700 pixels per unit of look: a pixel is about 0.35 D of blur.
inline CompileSettings settings(std::vector<double> powers_d, Assignment assignment) {
  Project project;
  project.projectors.resize(1);
  Projector& projector = project.projectors[0];
  projector.width_px = 256;
  projector.height_px = 192;
  projector.fx_px = projector.fy_px = 700.0;
  projector.cx_px = 128.0;
  projector.cy_px = 96.0;
  project.slices.powers_d = std::move(powers_d);
  project.slices.assignment = assignment;
  return compile_settings(project);
}

inline Drawable checkered(const glm::dvec2& size_m, const Rigid& pose, const glm::ivec2& squares, double a, double b) {
  Drawable drawable = support::standing(support::rectangle(size_m), pose);
  drawable.finish.kind = Finish::Kind::checker;
  drawable.finish.squares = squares;
  drawable.finish.a = glm::dvec3(a);
  drawable.finish.b = glm::dvec3(b);
  return drawable;
}

/// A screen 500 mm before the lens; a far card that fills the view at 800 mm from the lens and a near one at 360 mm.
inline Stage room(bool near_card = true) {
  Stage stage;
  stage.surfaces.push_back(
      support::surface_of(support::standing(support::rectangle({0.5, 0.4}), {{0.0, 0.0, -0.515}})));
  StagedObject far = support::object_of(checkered({0.5, 0.4}, {{0.0, 0.0, -0.815}}, {25, 20}, 0.8, 0.3));
  far.index = 0;
  stage.objects.push_back(far);
  if (!near_card) return stage;
  const double half = 0.1;
  StagedObject near = support::object_of(
      checkered({0.06, 0.06}, {{0.003, -0.004, -0.375}, {std::cos(half), 0.0, 0.0, std::sin(half)}}, {4, 4}, 0.7, 0.2));
  near.index = 1;
  stage.objects.push_back(near);
  return stage;
}

}  // namespace focalstage::cards
