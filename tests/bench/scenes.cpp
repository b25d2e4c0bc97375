#include "tests/bench/scenes.h"

#include "tests/support/shapes.h"

namespace focalstage::bench {
namespace {

using support::SharedMesh;

constexpr double screen_m = 0.515;  ///< from the pupils; 0.5 m from the lens

CompileSettings settings_for(const Stage& stage) {
  Project project;
  Projector projector;
  projector.pose = support::looking({0.15, 0.2, 0.0}, {0.0, 0.0, -screen_m});
  project.projectors.push_back(projector);
  project.slices.powers_d = {-1.5, -1.0, -0.5, 0.0, 0.5, 1.0};
  for (const StagedSurface& surface : stage.surfaces) {
    project.surfaces.emplace_back();
    project.surfaces.back().illumination = surface.illumination;
  }
  return compile_settings(project);
}

BenchScene scene(std::string name, StagedSurface surface, std::vector<StagedObject> objects, bool surfaces_hide) {
  BenchScene made;
  made.name = std::move(name);
  made.stage.surfaces = {std::move(surface)};
  made.stage.objects = std::move(objects);
  for (std::size_t i = 0; i < made.stage.objects.size(); ++i) made.stage.objects[i].index = i;
  const auto move = [](StagedObject& object) { object.drawables[0].world_from_mesh[3].x += 0.002; };
  made.one_moved = made.moved = made.stage;
  move(made.one_moved.objects[0]);
  for (StagedObject& object : made.moved.objects) move(object);
  made.settings = settings_for(made.stage);
  made.surfaces_hide = surfaces_hide;
  return made;
}

/// An object `away_m` from the pupils that covers the same part of the picture at any distance.
StagedObject blob_at(const SharedMesh& mesh, double x, double y, double away_m) {
  const double grown = away_m / screen_m;
  return support::object_of(support::standing(mesh, {{x * grown, y * grown, -away_m}, {1, 0, 0, 0}}, grown));
}

/// Three closed blobs of 12 * 76^2 = 69,312 triangles each, before, on and behind the screen.
std::vector<StagedObject> three_blobs() {
  return {blob_at(support::blob(0.052, 76, 0.25, 1), -0.11, -0.02, 0.36),
          blob_at(support::blob(0.052, 76, 0.25, 2), 0.0, 0.02, 0.55),
          blob_at(support::blob(0.052, 76, 0.25, 3), 0.11, -0.01, 1.1)};
}

}  // namespace

std::vector<BenchScene> bench_scenes() {
  const Rigid on_screen{{0.0, 0.0, -screen_m}, {1, 0, 0, 0}};
  const StagedSurface flat = support::surface_of(support::standing(support::rectangle({1.2, 0.9}), on_screen));
  const StagedSurface stepped = support::surface_of(support::standing(support::step({1.2, 0.9}, 0.15), on_screen));
  const StagedSurface curved =
      support::surface_of(support::standing(support::bumpy({1.2, 0.9}, 0.03, 100, 2.0), on_screen));

  Drawable slanted = support::standing(support::rectangle({4.0, 3.0}),
                                       {{0.0, 0.0, -0.6}, glm::angleAxis(0.9, glm::dvec3(0.0, 1.0, 0.0))});
  slanted.finish.kind = Finish::Kind::checker;
  slanted.finish.squares = {80, 60};
  slanted.finish.b = glm::dvec3(0.3);

  return {scene("bunnies", flat, three_blobs(), false),
          scene("teapot", stepped, {blob_at(support::blob(0.07, 22, 0.25, 4), 0.01, 0.0, 0.6)}, true),
          scene("plane", flat, {support::object_of(slanted)}, false), scene("bumpy", curved, three_blobs(), true)};
}

}  // namespace focalstage::bench
