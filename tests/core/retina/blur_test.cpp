#include "core/retina/blur.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/retina/disc.h"
#include "tests/core/retina/rig.h"

using namespace focalstage;
using namespace focalstage::retina_test;

namespace {

/// One pixel of a fine projector, seen from the left eye through +1 D.
struct Point {
  Stage stage = screen_stage();
  ProjectorModel projector = projector_at({0.0, 0.1, 0.0}, 8000.0, 64, 64);
  std::vector<std::uint8_t> codes = std::vector<std::uint8_t>(64 * 64, 0);
  RetinaInput input;
  RetinaView view;

  Point() {
    codes[32 * 64 + 32] = 255;
    input = input_of(stage, projector);
    input.exposures = {shown(codes, 1.0)};
    view.pupil_m = 0.006;
    view.width_px = view.height_px = 320;
    // The spot lies 31.5 mm to the right of the left eye and 515 mm away; through +1 D the look at it is stretched by
    // 515 / (515 - 0.015 * 500) = 1.01478.
    view.gaze = {0.0315 / 0.5075, 0.0};
    view.fov_deg = 2.0 * std::atan(160 * 2e-4) * 180.0 / M_PI;  // 0.2 mrad a pixel
  }
};

}  // namespace

TEST_CASE("a point spreads over the disc of pupil and defocus") {
  Point point;
  Retina retina;
  point.view.focus_d = 1.0;
  const Moments sharp = moments_of(*retina.view(point.input, point.view));
  CHECK(glm::length(sharp.centre - glm::dvec2(160.0)) < 1.0);  // the lit pixel's corner stands there
  CHECK(sharp.radius_px < 1.5);                                // 0.6 px of the projector's pixel, and the sampling
  // Its picture lies at 1/0.5 - 1 = 1 D from the lens: 1 / (1 + 0.015) = 0.985222 D from the pupil.
  for (const double focus_d : {-6.0, -3.0, -1.0, 0.0, 0.4, 0.7, 0.85, 0.95, 1.0, 1.05, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0}) {
    INFO("focus " << focus_d);
    point.view.focus_d = focus_d;
    const double expected_px = 0.003 * std::abs(1.0 / 1.015 - focus_d / (1.0 + 0.015 * focus_d)) / 2e-4;
    const auto image = retina.view(point.input, point.view);
    REQUIRE(image);
    const Moments seen = moments_of(*image);
    const double spread_px =
        std::sqrt(std::max(0.0, seen.radius_px * seen.radius_px - sharp.radius_px * sharp.radius_px));
    CHECK(std::abs(spread_px - expected_px) < 0.02 * expected_px + 0.15);
    CHECK(glm::length(seen.centre - sharp.centre) < 0.02);
  }
}

TEST_CASE("blur has an edge, no tail: the disc is a disc") {
  Point point;
  point.view.focus_d = 3.0;  // 0.003 (2.870813 - 0.985222) / 2e-4 = 28.3 px
  const auto image = Retina().view(point.input, point.view);
  REQUIRE(image);
  const float middle = at(*image, 160, 160);
  CHECK(middle > 0.0f);
  for (const int aside : {-22, 22}) {
    CHECK(at(*image, 160 + aside, 160) == doctest::Approx(middle).epsilon(0.02));
    CHECK(at(*image, 160, 160 + aside) == doctest::Approx(middle).epsilon(0.02));
  }
  for (const int aside : {-42, 42}) {
    CHECK(at(*image, 160 + aside, 160) == 0.0f);
    CHECK(at(*image, 160, 160 + aside) == 0.0f);
  }
}

TEST_CASE("blur keeps the light") {
  Point point;
  Retina retina;
  point.view.focus_d = 1.0;
  const auto sharp = retina.view(point.input, point.view);
  REQUIRE(sharp);
  const double light = moments_of(*sharp).sum;
  CHECK(light > 0.1);
  for (const double focus_d : {-6.0, -2.0, 0.0, 0.6, 0.9, 1.3, 2.0, 4.0}) {
    INFO("focus " << focus_d);
    point.view.focus_d = focus_d;
    const auto image = retina.view(point.input, point.view);
    REQUIRE(image);
    CHECK(moments_of(*image).sum == doctest::Approx(light).epsilon(1e-3));
  }
}

TEST_CASE("light from outside the picture blurs into it as far as it reaches") {
  Point point;
  point.view.focus_d = 3.0;  // 28.3 px
  Retina retina;
  const auto whole = retina.view(point.input, point.view);
  REQUIRE(whole);
  const double sum = moments_of(*whole).sum;
  point.view.gaze.x += 160 * 2e-4;  // the point on the picture's left edge
  const auto half = retina.view(point.input, point.view);
  REQUIRE(half);
  CHECK(moments_of(*half).sum == doctest::Approx(sum / 2.0).epsilon(0.03));
  point.view.gaze.x += 10 * 2e-4;  // 10 px outside: of a disc of 28.3 px lies beyond 10 px (acos(q) - q sqrt(1-q^2))/pi
  const double q = 10.0 / 28.284;
  const auto less = retina.view(point.input, point.view);
  REQUIRE(less);
  CHECK(moments_of(*less).sum ==
        doctest::Approx(sum * (std::acos(q) - q * std::sqrt(1.0 - q * q)) / M_PI).epsilon(0.05));
}

TEST_CASE("a pupil of no size blurs nothing") {
  Point point;
  Retina retina;
  point.view.focus_d = 1.0;
  const auto sharp = retina.view(point.input, point.view);
  point.view.pupil_m = 0.0;
  point.view.focus_d = -8.0;
  const auto pinhole = retina.view(point.input, point.view);
  REQUIRE(sharp);
  REQUIRE(pinhole);
  CHECK(sharp->rgb == pinhole->rgb);
}

TEST_CASE("discs hold all light, spread as discs do") {
  for (const double radius_px : {0.0, 0.3, 0.5, 0.75, 1.0, 1.5, 2.7, 4.0}) {
    INFO(radius_px);
    const Disc disc = disc_of(radius_px);
    double sum = 0.0, second = 0.0;
    for (int y = -disc.reach_px; y <= disc.reach_px; ++y) {
      for (int x = -disc.reach_px; x <= disc.reach_px; ++x) {
        sum += disc.row(y)[x];
        second += disc.row(y)[x] * x * x;
      }
    }
    CHECK(sum == doctest::Approx(1.0).epsilon(1e-6));
    // r^2 / 4, and 1/12 from sorting into pixels; where the disc does not leave its pixel, nothing.
    const double variance = radius_px <= 0.5 ? 0.0 : radius_px * radius_px / 4.0 + 1.0 / 12.0;
    if (radius_px == 0.0 || radius_px >= 1.0) CHECK(second == doctest::Approx(variance).epsilon(0.05));
  }
}

TEST_CASE("between two layers light is mixed by the square of the radius") {
  const BlurShare middle = BlurLayers::share(3.5f);  // between 3 and 4: (12.25 - 9) / (16 - 9)
  CHECK(middle.next == doctest::Approx(3.25 / 7.0));
  CHECK(BlurLayers::share(3.0f).next == 0.0f);
  CHECK(BlurLayers::share(4.0f).layer == middle.layer + 1);
  CHECK(BlurLayers::share(0.0f).layer == 0);
  CHECK(BlurLayers::share(1e9f).next == doctest::Approx(1.0));
}
