#include "core/optics/projector_model.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

using namespace focalstage;

namespace {

ProjectorModel model_of(PixelLayout layout) {
  ProjectorModel model;
  model.width_px = 91;
  model.height_px = 114;
  model.focal_px = {100.0, 200.0};
  model.centre_px = {45.0, 57.0};
  model.layout = layout;
  return model;
}

}  // namespace

TEST_CASE("the mirrors of a diamond lattice stand on the corners of squares turned by 45 degrees") {
  const ProjectorModel model = model_of(PixelLayout::diamond);
  const auto centre = [&](int column, int row) { return tangent_of_pixel(model, {column + 0.5, row + 0.5}); };
  for (const int row : {10, 11}) {
    // All four neighbours, half a column aside in the rows above and below, are equally far.
    const int right = row % 2 == 0 ? 20 : 21;
    const double pitch = glm::length(centre(right, row + 1) - centre(20, row));
    CHECK(pitch == doctest::Approx(std::sqrt(0.5) / 100.0));
    for (const int other : {row - 1, row + 1}) {
      for (const int column : {right - 1, right}) {
        CHECK(glm::length(centre(column, other) - centre(20, row)) == doctest::Approx(pitch));
      }
    }
  }
  CHECK(centre(20, 11).x - centre(20, 10).x == doctest::Approx(0.5 / 100.0));  // odd rows lie to the right
  CHECK(centre(20, 12).x == doctest::Approx(centre(20, 10).x));
}

TEST_CASE("each place belongs to one pixel, also outside the picture") {
  for (const PixelLayout layout : {PixelLayout::square, PixelLayout::diamond}) {
    ProjectorModel model = model_of(layout);
    for (const bool bent : {false, true}) {
      if (bent) model.distortion = {-0.1, 0.02, 0.001, -0.002};
      for (const double y : {-2.5, -1.0, -0.25, 0.0, 0.75, 1.0, 1.5, 2.0, 57.3, 113.9, 115.0}) {
        const glm::dvec2 pixel{33.25, y};
        const glm::dvec2 back = pixel_of_tangent(model, tangent_of_pixel(model, pixel + glm::dvec2(0.0, 1e-7)));
        CHECK(back.x == doctest::Approx(pixel.x));
        CHECK(back.y == doctest::Approx(y).epsilon(1e-6));
      }
    }
  }
  const ProjectorModel model = model_of(PixelLayout::diamond);
  CHECK(place_of_pixel(model, {3.0, -0.5}) == glm::dvec2(3.5, -0.5));  // row -1 is odd
  CHECK(place_of_pixel(model, {3.0, 1e300}).x == 3.0);
  CHECK(std::isinf(pixel_of_place(model, {std::numeric_limits<double>::infinity(), 1.0}).x));
}

TEST_CASE("places do not know of rows, and a square lattice's pixels are its places") {
  const ProjectorModel square = model_of(PixelLayout::square), diamond = model_of(PixelLayout::diamond);
  for (const glm::dvec2& at : {glm::dvec2(0.0, 0.0), glm::dvec2(12.3, 7.8), glm::dvec2(90.0, 33.3)}) {
    CHECK(tangent_of_place(square, at) == tangent_of_place(diamond, at));
    CHECK(tangent_of_pixel(square, at) == tangent_of_place(square, at));
    const glm::dvec2 tangent = tangent_of_place(square, at);
    CHECK(place_of_tangent(diamond, tangent) == pixel_of_tangent(square, tangent));
  }
}

TEST_CASE("a preview of another size is of a square lattice") {
  const ProjectorModel small = resized(model_of(PixelLayout::diamond), 45, 57);
  CHECK(small.layout == PixelLayout::square);
  CHECK(small.focal_px.y == doctest::Approx(100.0));
}

TEST_CASE("a project's projector brings its lattice") {
  Projector projector;
  CHECK(projector_model(projector).layout == PixelLayout::square);
  projector.pixel_layout = PixelLayout::diamond;
  CHECK(projector_model(projector).layout == PixelLayout::diamond);
}
