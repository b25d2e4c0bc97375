#pragma once

#include <memory>

#include "core/scene/project.h"
#include "core/stage/stage.h"

namespace focalstage {

/// A white card 0.45 m before the pupils, a screen behind it at 0.6 m, a projector between the eyes.
inline std::shared_ptr<const Project> a_project() {
  auto project = std::make_shared<Project>();
  project->name = "card";
  project->slices.powers_d = {-1.0, -0.5, 0.0};
  Projector projector;
  projector.name = "main";
  projector.width_px = 320;
  projector.height_px = 240;
  projector.fx_px = projector.fy_px = 400.0;
  projector.cx_px = 160.0;
  projector.cy_px = 120.0;
  project->projectors.push_back(projector);
  Surface screen;
  screen.name = "screen";
  screen.mesh.shape = PlaneMesh{{1.0, 0.8}};
  screen.placement.pose.position_m = {0.0, 0.0, -0.6};
  project->surfaces.push_back(screen);
  Object card;
  card.name = "card";
  card.mesh.shape = PlaneMesh{{0.2, 0.15}};
  card.placement.pose.position_m = {0.0, 0.0, -0.45};
  card.appearance = UnlitAppearance{};
  project->objects.push_back(card);
  return project;
}

inline std::shared_ptr<const Stage> staged(const Project& project, double x_m) {
  Project moved = project;
  moved.objects[0].placement.pose.position_m.x += x_m;
  return std::make_shared<const Stage>(*stage(moved, Assets{}, 0.0));
}

}  // namespace focalstage
