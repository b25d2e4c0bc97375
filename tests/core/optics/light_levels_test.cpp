#include "core/optics/light_levels.h"

#include <doctest/doctest.h>

using namespace focalstage;

TEST_CASE("levels: full white of each at its reference, against the least") {
  Project project;
  Projector a, b;
  a.lumens = 400.0;
  a.focus_m = 1.0;
  b = a;
  b.lumens = 600.0;
  b.focus_m = 0.5;  // four times as dense there
  project.projectors = {a, b};
  CHECK(light_levels(project)[0] == 1.0);
  CHECK(light_levels(project)[1] == doctest::Approx(6.0));
  project.slices.compensation.reference_m = 0.8;  // one for both
  CHECK(light_levels(project)[1] == doctest::Approx(1.5));
  project.projectors[1].exposure_ms = 0.25;  // half as long
  CHECK(light_levels(project)[0] == doctest::Approx(1.0 / 0.75));
  CHECK(light_levels(project)[1] == 1.0);
  project.projectors[0].lumens.reset();  // unknown of one: all alike
  CHECK(light_levels(project) == std::vector<double>{1.0, 1.0});
}
