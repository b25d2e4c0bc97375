#include "core/retina/retinas.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "tests/core/retina/rig.h"

using namespace focalstage;
using namespace focalstage::retina_test;

TEST_CASE("light of two projectors adds up, each by its level") {
  const Stage stage = screen_stage();
  const std::array<ProjectorModel, 2> projectors{projector_at({0.0, 0.0, 0.2}, 150.0, 200, 150),
                                                 projector_at({0.05, 0.0, 0.2}, 150.0, 200, 150)};
  std::array<std::vector<std::uint8_t>, 2> codes{std::vector<std::uint8_t>(200 * 150, 51),
                                                 std::vector<std::uint8_t>(200 * 150, 102)};
  std::vector<RetinaInput> inputs;
  for (std::size_t i = 0; i < 2; ++i) {
    inputs.push_back(input_of(stage, projectors[i]));
    inputs[i].exposures = {shown(codes[i], 0.0)};
  }
  inputs[1].level = 1.5;
  RetinaView view;
  view.width_px = 60;
  view.height_px = 40;
  view.fov_deg = 20.0;
  Retinas retinas;
  const auto both = retinas.view(inputs, view);
  REQUIRE(both);
  for (const float value : both->rgb) CHECK(value == doctest::Approx(0.2 + 1.5 * 0.4).epsilon(1e-4));
  const auto focus = retinas.driven_focus(inputs, view);
  REQUIRE(focus);
  const std::size_t middle = 20 * 60 + 30;
  CHECK(focus->luminance[middle] == doctest::Approx(0.8).epsilon(1e-4));
  CHECK(focus->vergence_d[middle] == doctest::Approx(1.0 / screen_m).epsilon(0.05));
  CHECK_FALSE(retinas.view({}, view));
}

TEST_CASE("two lights of unlike vergence: the mean by light, and what parts them in the spread") {
  DrivenFocus sum{1, 1, {3.0f}, {1.0f}, {0.0f}};
  add_light(DrivenFocus{1, 1, {1.0f}, {2.0f}, {0.0f}}, sum);
  CHECK(sum.luminance[0] == 4.0f);
  CHECK(sum.vergence_d[0] == doctest::Approx(1.25));
  CHECK(sum.spread_d[0] == doctest::Approx(std::sqrt(0.25 * 0.75)));
  add_light(DrivenFocus{1, 1, {0.0f}, {NAN}, {NAN}}, sum);  // dark
  CHECK(sum.vergence_d[0] == doctest::Approx(1.25));
  DrivenFocus dark{1, 1, {0.0f}, {NAN}, {NAN}};
  add_light(sum, dark);
  CHECK(dark.vergence_d[0] == doctest::Approx(1.25));
}
