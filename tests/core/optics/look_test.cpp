#include "core/optics/look.h"

#include <doctest/doctest.h>

#include <initializer_list>

#include <glm/geometric.hpp>

using namespace focalstage;

TEST_CASE("the stretched look is the direction w = (P - C) + (1 - v d_p)(C - E)") {
  const double lens_to_pupil_m = 0.015;
  const glm::dvec3 p{0.13, -0.07, -0.515};
  const glm::dvec3 c{0.0, 0.0, -lens_to_pupil_m};
  const double surface_m = 0.5;
  for (const double power_d : {-9.5, -1.0, 0.0, 0.75, 10.0}) {
    const glm::dvec3 w = (p - c) + (1.0 - power_d * surface_m) * c;  // E is the origin
    const glm::dvec2 look = straight_look(p) * look_stretch(power_d, surface_m, lens_to_pupil_m);
    CHECK(look.x == doctest::Approx(w.x / -w.z).epsilon(1e-13));
    CHECK(look.y == doctest::Approx(w.y / -w.z).epsilon(1e-13));
  }
}

TEST_CASE("a look through a point meets the point's plane at the point") {
  const glm::dvec3 p{0.1, 0.2, -0.7};
  const glm::dvec3 tilted = glm::normalize(glm::dvec3(0.3, -0.1, 1.0));
  CHECK(plane_distance_m(straight_look(p), p, tilted, 0.015) == doctest::Approx(0.685).epsilon(1e-13));
}

TEST_CASE("a look along the plane keeps the point's own distance") {
  const glm::dvec3 p{0.1, 0.0, -0.7};
  CHECK(plane_distance_m({0.0, 0.0}, p, {1.0, 0.0, 0.0}, 0.015) == doctest::Approx(0.685));
}
