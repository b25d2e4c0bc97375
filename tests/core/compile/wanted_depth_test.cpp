#include "core/compile/wanted_depth.h"

#include <doctest/doctest.h>

#include <numeric>

#include "core/optics/vergence.h"
#include "tests/core/compile/cards.h"
#include "tests/core/compile/eye_room.h"

using namespace focalstage;

namespace {

constexpr double lens_to_pupil_m = 0.015;

int count(const std::vector<std::uint8_t>& marks) { return std::accumulate(marks.begin(), marks.end(), 0); }

}  // namespace

TEST_CASE("the wanted vergence of every depth mode, from the pupil") {
  const std::vector<SliceSetup> slices = slice_setups({{-1.0, 0.5}}, lens_to_pupil_m);
  const double stands_m = 0.6;  // from the pupil
  const double r = 1.0 / stands_m;
  const auto at = [&](const VergenceRule& rule) {
    return wanted_vergence(rule, slices, 0.5, r, lens_to_pupil_m).at(r);
  };
  const double placed_d = 1.0 / (stands_m - lens_to_pupil_m);
  CHECK(at({1.0f, 0.0f, -1}) == doctest::Approx(r));
  CHECK(at({0.0f, 1.5f, -1}) == doctest::Approx(1.0 / (1.0 / 1.5 + lens_to_pupil_m)));
  CHECK(at({1.0f, 0.75f, -1}) == doctest::Approx(1.0 / (1.0 / (placed_d + 0.75) + lens_to_pupil_m)));
  CHECK(at({0.0f, 0.0f, 1}) == doctest::Approx(1.0 / (1.0 / (2.0 - 0.5) + lens_to_pupil_m)));
}

TEST_CASE("an offset is affine in the inverse depth to a thousandth of itself") {
  const VergenceRule rule{1.0f, -0.8f, -1};
  const WantedVergence wanted = wanted_vergence(rule, {}, 0.5, 2.0, lens_to_pupil_m);
  for (const double r : {1.2, 1.6, 2.0, 2.4, 2.8}) {
    const double at_lens_d = r / (1.0 - lens_to_pupil_m * r) - 0.8;
    CHECK(std::abs(wanted.at(r) - vergence_at_pupil_d(at_lens_d, lens_to_pupil_m)) < 0.8e-3);
  }
}

TEST_CASE("each pixel's wanted vergence and power") {
  const Stage stage = cards::room();
  const EyeRoom room(stage, cards::settings({-1.0, 0.0, 1.0}, Assignment::optimal));
  const WantedDepth wanted = room.wanted();
  CHECK(wanted.vergence_d[room.place(150, 100)] == doctest::Approx(1.0 / 0.375).epsilon(1e-4));  // the near card
  CHECK(wanted.power_d[room.place(150, 100)] == doctest::Approx(2.0 - 1.0 / 0.36).epsilon(1e-3));
  CHECK(wanted.vergence_d[room.place(20, 10)] == doctest::Approx(1.0 / 0.815).epsilon(1e-4));
  CHECK(wanted.power_d[room.place(20, 10)] == doctest::Approx(2.0 - 1.25).epsilon(1e-3));
}

TEST_CASE("an edge is where the jump's blur exceeds the pixels' distance") {
  Stage stage = cards::room();
  const CompileSettings settings = cards::settings({-1.0, 0.0, 1.0}, Assignment::optimal);
  // Two cards side by side; a pixel is 1/700 of look, so with a pupil of 4 mm the limit is 1 / 2.8 = 0.357 D.
  const auto edges = [&](double jump_d) {
    stage.objects[1].depth = {DepthMode::fixed, 2.0 + jump_d, 0};
    stage.objects[0].depth = {DepthMode::fixed, 2.0, 0};
    const EyeRoom room(stage, settings);
    return count(depth_edges(room.wanted(), room.looks, 0.004));
  };
  CHECK(edges(0.3) == 0);
  CHECK(edges(0.45) > 200);
  CHECK(edges(-0.45) > 200);
  stage.objects.erase(stage.objects.begin());  // an outline before nothing hides nothing
  const EyeRoom alone(stage, settings);
  CHECK(count(depth_edges(alone.wanted(), alone.looks, 0.004)) == 0);
}

TEST_CASE("marks widen to squares and stop at the rim") {
  std::vector<std::uint8_t> marks(7 * 5, 0);
  marks[0] = marks[2 * 7 + 4] = 1;
  const auto wide = widened(marks, 7, 5, 1);
  const std::vector<std::uint8_t> expected{1, 1, 0, 0, 0, 0, 0,  //
                                           1, 1, 0, 1, 1, 1, 0,  //
                                           0, 0, 0, 1, 1, 1, 0,  //
                                           0, 0, 0, 1, 1, 1, 0,  //
                                           0, 0, 0, 0, 0, 0, 0};
  CHECK(wide == expected);
  CHECK(widened(marks, 7, 5, 0) == marks);
  CHECK(count(widened(marks, 7, 5, 9)) == 35);
}
