#include "core/compile/pixel_looks.h"

#include <doctest/doctest.h>

#include <numeric>

#include <glm/geometric.hpp>

#include "tests/core/compile/cards.h"
#include "tests/core/compile/eye_room.h"

using namespace focalstage;

TEST_CASE("the raster of a plane in the eye's view: straight looks, their steps, and no tear") {
  const Stage stage = cards::room();
  for (const int samples : {1, 4}) {
    CompileSettings settings = cards::settings({0.0}, Assignment::optimal);
    settings.slices.samples_per_pixel = samples;
    const EyeRoom room(stage, settings);
    // Projector and screen are 515 mm apart, so is the left eye, 31.5 mm beside: only shifted.
    const LookTile& tile = room.tile(100, 50);
    const int i = 50 % 8 * 8 + 100 % 8;
    CHECK(tile.x[i] == doctest::Approx((100.5 - 128.0) / 700.0 + 0.0315 / 0.515).epsilon(1e-4));
    CHECK(tile.y[i] == doctest::Approx((96.0 - 50.5) / 700.0).epsilon(1e-4));
    CHECK(tile.surface_m[i] == doctest::Approx(0.5).epsilon(1e-5));
    REQUIRE(tile.usable);
    CHECK(glm::length(tile.look_per_pixel * glm::dvec2(1, 1) - glm::dvec2(1, -1) / 700.0) < 1e-6);
    CHECK(glm::length(tile.pixel_per_look * glm::dvec2(1, 1) - glm::dvec2(1, -1) * 700.0) < 0.1);
    CHECK(std::accumulate(room.looks.torn.begin(), room.looks.torn.end(), 0) == 0);
  }
}

TEST_CASE("a step tears the raster where it stands, and nowhere else") {
  Stage stage = cards::room();
  stage.surfaces[0] = support::surface_of(support::standing(support::step({0.5, 0.4}, 0.2), {{0.0, 0.0, -0.515}}));
  const EyeRoom room(stage, cards::settings({0.0}, Assignment::optimal), Side::right);
  int at_step = 0;
  for (int y = 0; y < 192; ++y) {
    for (int x = 0; x < 256; ++x) {
      if (room.looks.torn[room.place(x, y)] == 0) continue;
      CHECK(std::abs(x - 128) < 20);  // the wall is seen side-on
      ++at_step;
    }
  }
  CHECK(at_step >= 192);
}

TEST_CASE("nothing to see: nothing usable") {
  Stage stage = cards::room();
  stage.surfaces.clear();
  const EyeRoom room(stage, cards::settings({0.0}, Assignment::optimal));
  for (const LookTile& tile : room.looks.tiles) CHECK_FALSE(tile.usable);
}
