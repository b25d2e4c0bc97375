#include "editor/tools/fixtures.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace focalstage;

namespace {

Project room() {
  Project project;
  project.viewer.placement.pose.position_m = {0.0, 0.1, 0.3};
  Projector projector;
  projector.name = "main";
  projector.pose.position_m = {0.0, 1.0, 0.0};
  project.projectors.push_back(projector);
  Light lamp;
  lamp.name = "lamp";
  lamp.kind = LightKind::point;
  lamp.position_m = {1.0, 1.0, 0.0};
  project.lights = {lamp, Light{}};
  return project;
}

}  // namespace

TEST_CASE("viewer, projectors and lamps can be seen and taken hold of; a sun is nowhere") {
  const Project project = room();
  const auto staged = stage(project, Assets{}, 0.0);
  REQUIRE(staged);
  const auto all = fixtures(project, *staged);
  CHECK(all.size() == 3);
  for (const Fixture& fixture : all) {
    for (const Drawable& drawable : fixture.drawables) REQUIRE(drawable.mesh);
  }
  Picker picker;
  const auto hit = [&](const glm::dvec3& from, const glm::dvec3& way) {
    const auto found = first_with_fixtures(picker, *staged, all, {from, way});
    return found ? found->thing : StagedName{};
  };
  CHECK(hit({0.0, 0.1, 2.0}, {0, 0, -1}) == StagedName{"viewer", ""});
  CHECK(hit({0.0, 1.0, 2.0}, {0, 0, -1}) == StagedName{"projectors", "main"});
  CHECK(hit({1.0, 1.0, 2.0}, {0, 0, -1}) == StagedName{"lights", "lamp"});
  CHECK(drawables_of(*staged, all, {"lights", "lamp"}).size() == 1);
  CHECK(drawables_of(*staged, all, {"lights", "nobody"}).empty());
}

TEST_CASE("the glasses stand at the lens centres") {
  Project project = room();
  project.glasses.lens_to_pupil_mm = 20.0;
  const auto staged = stage(project, Assets{}, 0.0);
  const Fixture viewer = fixtures(project, *staged).front();
  const double half_m = 0.5 * project.viewer.interpupillary_mm * 1e-3;
  for (const double x_m : {-half_m, half_m}) {
    const glm::dvec3 lens_m{x_m, 0.1, 0.3 - 0.020};
    CHECK(std::any_of(viewer.drawables.begin(), viewer.drawables.end(), [&](const Drawable& drawable) {
      return glm::length(glm::dvec3(drawable.world_from_mesh[3]) - lens_m) < 1e-9;
    }));
  }
}
