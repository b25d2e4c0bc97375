#include "core/compile/blend.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <glm/geometric.hpp>

#include "tests/support/shapes.h"

// Weights of several projectors at points of surfaces, asked of points that the test chose.

using namespace focalstage;

namespace {

constexpr double wall_m = 1.0;  ///< before the projectors, which look along -Z

BlendProjector projector_at(double x_m, int width_px = 400, int height_px = 300) {
  BlendProjector one;
  one.model.width_px = width_px;
  one.model.height_px = height_px;
  one.model.focal_px = glm::dvec2(400.0);
  one.model.centre_px = {width_px / 2.0, height_px / 2.0};
  one.model.world_from_projector = {{x_m, 0.0, 0.0}, {1, 0, 0, 0}};
  return one;
}

struct Room {
  std::vector<BlendProjector> projectors;
  std::vector<StagedSurface> surfaces;
  std::vector<ViewDrawable> seen;
  std::unique_ptr<Blend> blend;

  Room(std::vector<BlendProjector> given, const std::vector<Drawable>& things) : projectors(std::move(given)) {
    for (const Drawable& thing : things) surfaces.push_back(support::surface_of(thing));
    seen = drawables_of(surfaces);
    blend = std::make_unique<Blend>(projectors, seen, portable_kernel);
  }
  Room(const Room&) = delete;  // the blend refers to the rest
  Room& operator=(const Room&) = delete;

  /// Of each projector at points of one surface, by triangle 0 or 1 of its rectangle; at most a tile of them.
  std::vector<Blend::Tile> tiles(const std::vector<glm::dvec3>& world_m, std::int32_t drawable, bool thins) const {
    std::vector<Blend::Tile> all(projectors.size());
    for (std::size_t p = 0; p < projectors.size(); ++p) {
      TileMet met;
      std::fill_n(met.drawable, tile_samples, -1);
      const Rigid own_from_world = projectors[p].model.world_from_projector.inverse();
      for (std::size_t i = 0; i < world_m.size(); ++i) {
        const glm::dvec3 at = own_from_world.point(world_m[i]);
        met.drawable[i] = drawable;
        met.triangle[i] = 0;
        met.x[i] = at.x, met.y[i] = at.y, met.z[i] = at.z;
        met.any = true;
      }
      blend->share(p, met, thins, all[p]);
    }
    return all;
  }

  double weight(std::size_t projector, const glm::dvec3& world_m, std::int32_t drawable = 0) const {
    return tiles({world_m}, drawable, false)[projector].weight[0];
  }
};

Drawable wall() { return support::standing(support::rectangle({6.0, 6.0}), Rigid{{0.0, 0.0, -wall_m}, {1, 0, 0, 0}}); }

double smooth(double t) { return t <= 0.0 ? 0.0 : t >= 1.0 ? 1.0 : 3.0 * t * t - 2.0 * t * t * t; }

}  // namespace

TEST_CASE("square on a wall, weights are what the distances to the edges say") {
  // Pictures of 1 m x 0.75 m, 0.6 m apart: 400 px a metre.
  const Room room({projector_at(-0.3), projector_at(0.3)}, {wall()});
  for (const double y_m : {-0.36, -0.1, 0.0, 0.2}) {
    for (double x_m = -0.19; x_m < 0.2; x_m += 0.02) {
      const double down = smooth((0.375 - y_m) * 400.0 / 64.0) * smooth((0.375 + y_m) * 400.0 / 64.0);
      const double left = smooth((0.2 - x_m) * 400.0 / 64.0) * smooth((x_m + 0.8) * 400.0 / 64.0) * down;
      const double right = smooth((0.2 + x_m) * 400.0 / 64.0) * smooth((0.8 - x_m) * 400.0 / 64.0) * down;
      CAPTURE(x_m);
      CAPTURE(y_m);
      CHECK(room.weight(0, {x_m, y_m, -wall_m}) == doctest::Approx(left / (left + right)).epsilon(1e-6));
    }
  }
}

TEST_CASE("where one projector alone lights, it has all, up to its very edge") {
  const Room room({projector_at(-0.3), projector_at(0.3)}, {wall()});
  for (const double x_m : {-0.7999, -0.79, -0.5, -0.2001}) CHECK(room.weight(0, {x_m, 0.0, -wall_m}) == 1.0);
  CHECK(room.weight(1, {0.7999, 0.3749, -wall_m}) == 1.0);
}

TEST_CASE("a shadow takes weight away before its rim, without a step, and gives it to the other") {
  // A bar before the wall, 40 mm wide: it keeps the light of projector 1 off a band of the wall.
  const Drawable bar = support::standing(support::rectangle({0.04, 6.0}), Rigid{{0.0, 0.0, -0.8}, {1, 0, 0, 0}});
  const Room room({projector_at(-0.3, 800), projector_at(0.3, 800)}, {wall(), bar});
  // Seen from x = 0.3 the bar's edges at -0.02 and 0.02 land on the wall at 0.3 + (x - 0.3) / 0.8.
  const double from_m = 0.3 - 0.32 / 0.8, to_m = 0.3 - 0.28 / 0.8;
  double last = room.weight(0, {from_m - 0.3, 0.0, -wall_m}), steepest = 0.0;
  CHECK(last == doctest::Approx(0.5).epsilon(1e-6));  // far from all rims
  for (double x_m = from_m - 0.3; x_m < from_m - 0.0005; x_m += 0.0005) {
    const double now = room.weight(0, {x_m, 0.0, -wall_m});
    steepest = std::max(steepest, std::abs(now - last));
    last = now;
  }
  CHECK(last > 0.995);
  CHECK(steepest < 0.005);  // over 160 mm from a half to all: at most 1.5 times the mean step, and a pixel's roundness
  for (double x_m = from_m + 0.001; x_m < to_m; x_m += 0.005) {
    CHECK(room.weight(0, {x_m, 0.0, -wall_m}) == 1.0);
  }
  CHECK(room.weight(0, {to_m + 0.001, 0.0, -wall_m}) > 0.99);
  // The bar itself is lit by both; no shadow lies on it.
  CHECK(room.weight(0, {-0.019, 0.0, -0.8}, 1) == doctest::Approx(0.5).epsilon(1e-6));
}

TEST_CASE("weights sum to one on a leaning wall behind a bar, for three projectors") {
  const Drawable leaning = support::standing(support::rectangle({3.0, 3.0}),
                                             Rigid{{0.0, 0.0, -wall_m}, glm::angleAxis(0.6, glm::dvec3(0, 1, 0))});
  const Drawable bar = support::standing(support::rectangle({0.05, 0.3}), Rigid{{0.02, 0.1, -0.7}, {1, 0, 0, 0}});
  BlendProjector tilted = projector_at(0.2);
  tilted.model.world_from_projector = support::looking({0.2, 0.4, 0.2}, {0.0, 0.0, -wall_m});
  tilted.model.distortion = {-0.1, 0.02, 0.003, -0.002, 0.01};
  const Room room({projector_at(-0.3), projector_at(0.3), tilted}, {leaning, bar});
  const glm::dmat4& world_from_wall = leaning.world_from_mesh;
  int shared = 0, alone = 0;
  for (double y_m = -0.3; y_m <= 0.3; y_m += 0.05) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < tile_samples; ++i)
      points.emplace_back(glm::dvec3(world_from_wall * glm::dvec4(-0.32 + 0.01 * i, y_m, 0.0, 1.0)));
    const std::vector<Blend::Tile> all = room.tiles(points, 0, false);
    for (int i = 0; i < tile_samples; ++i) {
      // Whoever is asked takes its own light for granted: where it is in shadow its weight is next to nothing.
      const double sum = all[0].weight[i] + all[1].weight[i] + all[2].weight[i];
      CHECK(sum == doctest::Approx(1.0).epsilon(1e-6));
      const double most = std::max({all[0].weight[i], all[1].weight[i], all[2].weight[i]});
      shared += most < 0.9 ? 1 : 0;
      alone += most > 0.999 ? 1 : 0;
    }
  }
  CHECK(shared > 100);
  CHECK(alone > 10);
}

TEST_CASE("black of all that light a point adds up, by how densely their light falls") {
  std::vector<BlendProjector> projectors{projector_at(-0.3), projector_at(0.3)};
  projectors[0].black_level = 0.01;
  projectors[1].black_level = 0.02;
  projectors[1].level = 1.5;
  projectors[1].reference_m = 2.0;  // the wall stands at half of it: four times as much
  const Room room(projectors, {wall()});
  const auto black = [&](double x_m, bool thins) { return room.tiles({{x_m, 0.0, -wall_m}}, 0, thins)[0].black[0]; };
  CHECK(black(0.0, false) == doctest::Approx(0.03));
  CHECK(black(0.0, true) == doctest::Approx(0.01 + 0.02 * 1.5 * 4.0));
  CHECK(black(-0.5, true) == doctest::Approx(0.01));
}
