#include "core/compile/ray_samples.h"

#include <doctest/doctest.h>

#include <cmath>

#include <glm/geometric.hpp>

using namespace focalstage;

TEST_CASE("rays fill pupil and pixel evenly and are shifted nowhere") {
  glm::dvec2 pupil(0.0), pixel(0.0), pupil_square(0.0), pixel_square(0.0);
  double together = 0.0;
  for (const RaySample& ray : ray_samples()) {
    CHECK(glm::length(ray.pupil) < 1.02);
    CHECK(std::abs(ray.pixel.x) <= 0.52);
    CHECK(std::abs(ray.pixel.y) <= 0.52);
    pupil += ray.pupil;
    pixel += ray.pixel;
    pupil_square += ray.pupil * ray.pupil;
    pixel_square += ray.pixel * ray.pixel;
    together += ray.pupil.x * ray.pixel.x + ray.pupil.y * ray.pixel.y;
  }
  const double n = rays_per_pixel;
  CHECK(glm::length(pupil) / n < 1e-12);
  CHECK(glm::length(pixel) / n < 1e-12);
  // Mean squares of a disc of radius 1 and a square of side 1.
  CHECK(pupil_square.x / n == doctest::Approx(0.25).epsilon(0.02));
  CHECK(pupil_square.y / n == doctest::Approx(0.25).epsilon(0.02));
  CHECK(pixel_square.x / n == doctest::Approx(1.0 / 12.0).epsilon(0.05));
  CHECK(pixel_square.y / n == doctest::Approx(1.0 / 12.0).epsilon(0.05));
  CHECK(std::abs(together) / n < 0.02);
}
