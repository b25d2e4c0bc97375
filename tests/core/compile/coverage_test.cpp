#include "core/compile/coverage.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace focalstage;

namespace {

Drawable plane(double width_m, double height_m, glm::dvec3 centre) {
  Mesh mesh;
  const double x = width_m / 2.0;
  const double y = height_m / 2.0;
  mesh.positions_m = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  Drawable drawable{std::make_shared<const Mesh>(mesh), glm::dmat4(1.0), {}};
  drawable.world_from_mesh[3] = glm::dvec4(centre, 1.0);
  return drawable;
}

Stage room(const Drawable& surface, const Drawable& object) {
  Stage stage;
  stage.surfaces.push_back({"screen", 0, 0.0, {}, {surface}});
  stage.objects.push_back({"thing", 3, {}, {}, {object}});
  return stage;
}

ProjectorModel wide_projector() { return {1000, 1000, {500, 500}, {500, 500}, {}, {}}; }

std::vector<ObjectCoverage> measure_coverage(const Stage& stage, const ProjectorModel& projector,
                                             double lens_to_pupil_m, double lens_aperture_m) {
  return CoverageMeter(projector, lens_to_pupil_m, lens_aperture_m).measure(stage);
}

double share(std::uint64_t part, const ObjectCoverage& of) {
  return static_cast<double>(part) / static_cast<double>(of.looks);
}

}  // namespace

TEST_CASE("an object well within everything misses nothing") {
  const auto coverage =
      measure_coverage(room(plane(4, 4, {0, 0, -1}), plane(0.2, 0.2, {0, 0, -0.8})), wide_projector(), 0.015, 0.016);
  REQUIRE(coverage.size() == 1);
  CHECK(coverage[0].index == 3);
  CHECK(coverage[0].looks > 3000);
  CHECK(coverage[0].off_surface == 0);
  CHECK(coverage[0].outside_projector == 0);
  CHECK(coverage[0].outside_lens == 0);
}

TEST_CASE("half of an object beyond the surface's edge is off the surface") {
  // The eyes stand at x = -+0.0315; at 1 m the object's plane coincides with the surface's, so parallax does not
  // matter.
  const auto coverage = measure_coverage(room(plane(0.5, 2, {-0.25, 0, -1.0001}), plane(0.2, 0.2, {0, 0, -1})),
                                         wide_projector(), 0.015, 0.016);
  CHECK(share(coverage[0].off_surface, coverage[0]) == doctest::Approx(0.5).epsilon(0.02));
}

TEST_CASE("what the projector's frame leaves out is counted, and so is a shadow") {
  ProjectorModel narrow = wide_projector();
  narrow.centre_px.x = 1000.0;  // sees only x < 0
  const Stage stage = room(plane(4, 4, {0, 0, -1.0001}), plane(0.2, 0.2, {0, 0, -1}));
  const auto half = measure_coverage(stage, narrow, 0.015, 0.016);
  CHECK(share(half[0].outside_projector, half[0]) == doctest::Approx(0.5).epsilon(0.02));

  Stage shadowed = stage;  // from 2 m above, a board hangs in the projector's way, out of the eyes'
  ProjectorModel above = wide_projector();
  above.world_from_projector.position_m = {0, 1.0, 0};
  shadowed.surfaces.push_back({"board", 1, 0.0, {}, {plane(4, 0.2, {0, 0.5, -0.5})}});
  const auto dark = measure_coverage(shadowed, above, 0.015, 0.016);
  CHECK(dark[0].outside_projector == dark[0].looks);
}

TEST_CASE("a 16 mm lens 15 mm before the pupil shows 28 degrees") {
  // Beyond tan = 8 / 15 a look misses the lens: of a strip from 0 to 1.0666 straight to the right, half.
  const double edge = 8.0 / 15.0;
  const Stage stage = room(plane(9, 9, {0, 0, -1.0001}), plane(edge * 2, 0.001, {edge, 0, -1}));
  Stage cyclops = stage;
  cyclops.interpupillary_m = 1e-6;
  const auto coverage = measure_coverage(cyclops, wide_projector(), 0.015, 0.016);
  CHECK(share(coverage[0].outside_lens, coverage[0]) == doctest::Approx(0.5).epsilon(0.02));
}

TEST_CASE("an object around the viewer and a folded distortion are survived") {
  const auto around =
      measure_coverage(room(plane(4, 4, {0, 0, -1}),
                            [] {
                              Drawable floor = plane(4, 4, {0, -0.1, 0});
                              floor.world_from_mesh[1] = {0, 0, 1, 0};  // lies flat, reaching behind the viewer
                              floor.world_from_mesh[2] = {0, -1, 0, 0};
                              return floor;
                            }()),
                       wide_projector(), 0.015, 0.016);
  CHECK(around[0].looks > 0);
  ProjectorModel folded = wide_projector();
  folded.focal_px = {2000, 2000};
  folded.distortion = {-0.5, 0.0, 0.0, 0.0};  // r (1 - 0.5 r^2) comes back to the centre at r = 1.41
  const auto aside =
      measure_coverage(room(plane(9, 9, {0, 0, -1.0001}), plane(0.1, 0.1, {1.4, 0, -1})), folded, 0.015, 0.016);
  CHECK(aside[0].outside_projector == aside[0].looks);
}

TEST_CASE("a meter that keeps what stood still measures as a fresh one does") {
  Stage stage = room(plane(0.6, 0.6, {0, 0, -1.2}), plane(0.3, 0.3, {0.2, 0, -0.8}));
  stage.surfaces.push_back({"board", 1, 0.0, {}, {plane(0.2, 2, {0.1, 0, -1.0})}});
  CoverageMeter meter(wide_projector(), 0.015, 0.016);
  const auto check = [&] {
    const ObjectCoverage kept = meter.measure(stage)[0];
    const ObjectCoverage fresh = measure_coverage(stage, wide_projector(), 0.015, 0.016)[0];
    CHECK(kept.looks == fresh.looks);
    CHECK(kept.off_surface == fresh.off_surface);
    CHECK(kept.outside_projector == fresh.outside_projector);
    CHECK(kept.outside_lens == fresh.outside_lens);
    return kept;
  };
  const ObjectCoverage first = check();
  stage.objects[0].drawables[0].world_from_mesh[3].x = 0.1;
  CHECK(check().off_surface != first.off_surface);  // the object moves
  const std::uint64_t before = check().off_surface;
  stage.surfaces[0].drawables[0].world_from_mesh[3].x = 0.3;
  CHECK(check().off_surface != before);  // a surface moves
  stage.world_from_viewer.position_m.x = 0.05;
  check();  // the viewer
  stage.interpupillary_m = 0.05;
  check();
  stage.surfaces.pop_back();
  check();
}
