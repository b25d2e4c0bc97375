#include "tests/exact/random_scene.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "tests/exact/random_things.h"

namespace focalstage::exact {
namespace {

using support::Chance;
using support::SharedMesh;

/// Depths are drawn evenly in dioptres, as eyes count them.
double distance_m(Chance& chance, double near_m, double far_m) {
  return 1.0 / chance.between(1.0 / far_m, 1.0 / near_m);
}

void draw_slices(Chance& chance, Project& project, std::string& story) {
  Slices& slices = project.slices;
  const double spacing_d = chance.between(0.2, 1.0);
  const int count = chance.whole(1, 6);
  const double lowest_d = chance.between(-3.0, 1.0);
  for (int n = 0; n < count; ++n) slices.powers_d.push_back(lowest_d + spacing_d * (n + chance.between(-0.2, 0.2)));
  for (std::size_t n = slices.powers_d.size(); n > 1; --n) {
    std::swap(slices.powers_d[n - 1],
              slices.powers_d[static_cast<std::size_t>(chance.whole(0, static_cast<int>(n) - 1))]);
  }
  if (chance.one_in(8)) slices.powers_d.push_back(slices.powers_d.front());
  if (chance.one_in(4)) slices.powers_d.back() = 0.0;
  slices.assignment = chance.one_in(2) ? Assignment::nearest : Assignment::linear;
  slices.breathing = chance.one_in(2) ? Breathing::exact : (chance.one_in(3) ? Breathing::off : Breathing::planar);
  slices.samples_per_pixel = chance.one_in(3) ? 4 : (chance.one_in(10) ? 9 : 1);
  story.append(" | ").append(std::to_string(slices.powers_d.size())).append(" slices");
  story += slices.assignment == Assignment::nearest ? " nearest" : " linear";
  story += slices.breathing == Breathing::exact ? " exact" : (slices.breathing == Breathing::off ? " off" : " planar");
  story.append(" spp ").append(std::to_string(slices.samples_per_pixel));
}

void draw_projector(Chance& chance, Project& project, const glm::dvec3& target_m, std::string& story) {
  Projector projector;
  projector.width_px = chance.whole(90, 180);
  projector.height_px = chance.whole(70, 140);
  projector.fx_px = projector.width_px * chance.between(0.9, 1.8);
  projector.fy_px = projector.fx_px * chance.between(0.9, 1.1);
  projector.cx_px = projector.width_px * chance.between(0.35, 0.65);
  projector.cy_px = projector.height_px * chance.between(0.35, 0.65);
  projector.bits = chance.one_in(4) ? chance.whole(1, 7) : 8;
  projector.color = chance.one_in(3) ? ColorMode::rgb : ColorMode::gray;
  projector.gamma = chance.one_in(2) ? 1.0 : chance.between(0.5, 2.6);
  if (chance.one_in(2)) {
    projector.distortion = {chance.between(-0.2, 0.1), chance.between(-0.05, 0.05), chance.between(-0.01, 0.01),
                            chance.between(-0.01, 0.01), chance.between(-0.02, 0.02)};
    if (chance.one_in(3)) projector.distortion.insert(projector.distortion.end(), {0.01, -0.02, 0.005});
    story += " distorted";
  }
  projector.pose = support::looking(chance.within(0.3), target_m, chance.between(-0.3, 0.3));
  story += projector.color == ColorMode::rgb ? " rgb" : " gray";
  story.append(" ").append(std::to_string(projector.width_px)).append("x").append(std::to_string(projector.height_px));
  project.projectors.push_back(projector);
}

void draw_surfaces(Chance& chance, Stage& stage, const Rigid& world_from_viewer, double away_m, std::string& story) {
  story += " | surfaces";
  const int count = chance.one_in(3) ? chance.whole(2, 3) : 1;
  for (int i = 0; i < count; ++i) {
    const double size_m = i == 0 ? away_m * chance.between(0.8, 2.0) : away_m * chance.between(0.1, 0.4);
    const double depth_m = i == 0 ? away_m : away_m * chance.between(0.6, 0.95);
    const glm::dvec3 place{i == 0 ? glm::dvec2(0.0) : glm::dvec2(chance.within(0.25 * away_m)), -depth_m};
    const Rigid world_from_mesh = world_from_viewer * Rigid{place, turned(chance, chance.one_in(3) ? 55.0 : 25.0)};
    const double illumination = chance.one_in(3) ? chance.between(0.0, 0.6) : 0.0;
    stage.surfaces.push_back(
        support::surface_of(support::standing(random_surface(chance, size_m, story), world_from_mesh), illumination));
    stage.surfaces.back().index = static_cast<std::size_t>(i);
  }
}

void draw_objects(Chance& chance, Stage& stage, const Rigid& world_from_viewer, double away_m, std::size_t slices,
                  std::string& story) {
  story += " | objects";
  const int count = chance.whole(1, 4);
  for (int i = 0; i < count; ++i) {
    const double depth_m = distance_m(chance, 0.5 * away_m, 4.0 * away_m);
    const glm::dvec3 place{glm::dvec2(chance.within(0.25 * depth_m)), -depth_m};
    const Rigid world_from_mesh = world_from_viewer * Rigid{place, turned(chance, 180.0)};
    const SharedMesh mesh = random_object(chance, depth_m * chance.between(0.2, 0.9), story);
    Drawable drawable = support::standing(mesh, world_from_mesh, chance.between(0.8, 1.2));
    if (chance.one_in(4))
      drawable.world_from_mesh[chance.whole(0, 2)] *= chance.between(-1.5, -0.5);  // mirrored, uneven
    drawable.finish = random_finish(chance, story);
    stage.objects.push_back(support::object_of(drawable, random_depth(chance, slices, story)));
    stage.objects.back().index = static_cast<std::size_t>(i);
  }
}

/// The next moment: something moves, turns or bends; the rest keeps its meshes and places.
Stage moved(Chance& chance, const Stage& before, std::string& story) {
  Stage after = before;
  if (chance.one_in(2)) {
    glm::dmat4& world =
        after.surfaces[static_cast<std::size_t>(chance.whole(0, static_cast<int>(after.surfaces.size()) - 1))]
            .drawables[0]
            .world_from_mesh;
    world = Rigid{chance.within(0.03), turned(chance, 3.0)}.matrix() * world;
    story += " moving-surface";
  }
  if (chance.one_in(2)) {
    Drawable& drawable = after.surfaces[0].drawables[0];
    auto bent = std::make_shared<Mesh>(*drawable.mesh);
    for (glm::dvec3& position : bent->positions_m) position.z += 0.01 * std::sin(9.0 * position.x);
    drawable.mesh = bent;
    story += " bending-surface";
  }
  if (chance.one_in(2)) {
    Drawable& drawable = after.objects[0].drawables[0];
    drawable.world_from_mesh = Rigid{chance.within(0.03), turned(chance, 5.0)}.matrix() * drawable.world_from_mesh;
    story += " moving-object";
  }
  if (chance.one_in(3)) {
    after.world_from_viewer.position_m += chance.within(0.02);
    story += " moving-viewer";
  }
  return after;
}

}  // namespace

RandomScene random_scene(std::uint64_t seed) {
  Chance chance(seed);
  RandomScene scene;
  scene.seed = seed;
  scene.story = "seed " + std::to_string(seed);
  Stage stage;
  stage.world_from_viewer = {chance.within(0.5), turned(chance, chance.one_in(2) ? 5.0 : 180.0)};
  stage.interpupillary_m = chance.between(0.055, 0.07);
  const double away_m = distance_m(chance, 0.35, 1.2);

  Project project;
  project.glasses.lens_to_pupil_mm = chance.between(5.0, 25.0);
  draw_slices(chance, project, scene.story);
  const glm::dvec3 target_m = stage.world_from_viewer.point({0.0, 0.0, -away_m});
  draw_projector(chance, project, target_m, scene.story);
  Rigid& projector = project.projectors[0].pose;
  projector =
      support::looking(stage.world_from_viewer.point(projector.position_m), target_m, chance.between(-0.3, 0.3));

  draw_surfaces(chance, stage, stage.world_from_viewer, away_m, scene.story);
  draw_objects(chance, stage, stage.world_from_viewer, away_m, project.slices.powers_d.size(), scene.story);
  for (int i = chance.whole(0, 3); i > 0; --i) stage.lights.push_back(random_light(chance));
  for (const StagedSurface& surface : stage.surfaces) {
    project.surfaces.emplace_back();
    project.surfaces.back().illumination = surface.illumination;
  }
  if (chance.one_in(3)) {
    project.projectors[0].focus_m = away_m;
    project.projectors[0].depth_of_field_d = chance.between(0.1, 2.0);
  }
  scene.settings = compile_settings(project);
  scene.frames.push_back(stage);
  if (chance.one_in(3)) scene.frames.push_back(moved(chance, stage, scene.story));
  return scene;
}

}  // namespace focalstage::exact
