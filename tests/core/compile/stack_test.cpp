// The parts of the focal stack: plan and optics, target, fields and solver.

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

#include "core/compile/compile.h"
#include "core/compile/stack_fields.h"
#include "core/compile/stack_plan.h"
#include "core/compile/stack_solver.h"
#include "core/compile/stack_target.h"
#include "core/optics/look.h"
#include "core/optics/vergence.h"
#include "tests/core/compile/cards.h"
#include "tests/core/compile/eye_room.h"
#include "tests/support/chance.h"

using namespace focalstage;

namespace {

const StackBudget ample{1e9, [](std::size_t) { return 1.0; }};

StackPlan plan_of(const EyeRoom& room, const StackBudget& budget = ample) {
  return stack_plan(room.wanted(), room.looks, room.slices, room.eye.lens_to_pupil_m, budget);
}

/// One column of tiles, each seeing only its own pixels: as with a pupil of no width.
StackPlan pinhole_plan(std::size_t slices, int tiles) {
  StackPlan plan;
  plan.grid = {8, 8 * tiles};
  plan.foci = 2 * static_cast<int>(slices) - 1;
  for (std::size_t n = 0; n < slices; ++n) plan.slices.push_back(n);
  for (int i = 0; i < tiles; ++i) {
    plan.slot_of.push_back(i);
    StackTile tile;
    tile.row = i;
    tile.asked = tile.counted = ~std::uint64_t{0};
    tile.free.assign(slices, ~std::uint64_t{0});
    tile.spans.assign(slices * plan.focus_count(), {0, 0, 1, 1, 0});
    tile.shares = {1.0f};
    plan.tiles.push_back(tile);
  }
  plan.asked_tiles = plan.tiles.size();
  return plan;
}

double product(const StackField& a, const StackField& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

TEST_CASE("a cell sees all of its light, and the blur is a disc of the geometry's radius about the shifted pixel") {
  const Stage stage = cards::room();
  const EyeRoom room(stage, cards::settings({-1.0, 0.0, 1.0}, Assignment::optimal));
  const StackPlan plan = plan_of(room);
  REQUIRE(plan.slices == std::vector<std::size_t>{0, 1, 2});
  REQUIRE(plan.foci == 5);
  CHECK(plan.pupil_m == usual_pupil_m);
  for (const StackTile& tile : plan.tiles) {
    const glm::dvec2 look = room.tile(tile.column * 8, tile.row * 8).look;
    for (std::size_t n = 0; n < 3; ++n) {
      for (std::size_t k = 0; k < 5; ++k) {
        const StackSpan& span = tile.spans[n * 5 + k];
        double sum = 0.0;
        glm::dvec2 mean(0.0), square(0.0);
        for (int i = 0; i < span.width * span.height; ++i) {
          const double share = tile.shares[span.first + static_cast<std::size_t>(i)];
          const glm::dvec2 at(span.x + i % span.width, span.y + i / span.width);
          sum += share;
          mean += share * at;
          square += share * at * at;
        }
        CHECK(sum == doctest::Approx(1.0).epsilon(1e-5));
        // Slices lie at 1/0.5 - v and focuses half-way too, all as seen from the pupil.
        const auto from_pupil = [](double vergence_d) { return vergence_d / (1.0 + 0.015 * vergence_d); };
        const double a = from_pupil(2.0 - (static_cast<double>(n) - 1.0));
        const double f = from_pupil(2.0 - (0.5 * static_cast<double>(k) - 1.0));
        const double radius_px = 0.004 * std::abs(a - f) / 2.0 * 700.0;
        const glm::dvec2 moved = look * (look_stretch(static_cast<double>(n) - 1.0, 0.5, 0.015) - 1.0) * 700.0;
        CHECK(glm::length(mean - glm::dvec2(-moved.x, moved.y)) < 0.01);
        // A disc's mean square is r^2 / 4; sharing between neighbours adds part (1 - part), at most a quarter.
        const glm::dvec2 spread = square - mean * mean;
        for (const double each : {spread.x, spread.y}) {
          CHECK(each >= 0.98 * radius_px * radius_px / 4.0 - 1e-4);
          CHECK(each <= 1.02 * radius_px * radius_px / 4.0 + 0.2501);
        }
      }
    }
  }
}

TEST_CASE("a plan holds to its budget and keeps the tiles with the most edges") {
  const Stage stage = cards::room();
  const EyeRoom room(stage, cards::settings({-1.0, 0.0, 1.0}, Assignment::optimal));
  const StackPlan all = plan_of(room);
  const StackPlan some = plan_of(room, {20.0, [](std::size_t) { return 1.0; }});
  CHECK(all.left_tiles == 0);
  CHECK(some.asked_tiles == 20);
  CHECK(some.left_tiles == all.asked_tiles - 20);
  CHECK(plan_of(room, {0.5, [](std::size_t) { return 1.0; }}).empty());
}

TEST_CASE("many slices count for more, so that time and memory stay bounded") {
  const Stage stage = cards::room();
  std::vector<double> powers_d;
  for (int i = 0; i < 64; ++i) powers_d.push_back(-1.2 + 0.035 * i);
  const EyeRoom room(stage, cards::settings(powers_d, Assignment::optimal));
  const StackPlan plan = plan_of(room, {2500.0, [](std::size_t) { return 1.0; }});
  CHECK(plan.slice_count() > 40);
  CHECK(plan.left_tiles > 0);
  const auto pairs = static_cast<double>(plan.slice_count() * plan.focus_count());
  CHECK(static_cast<double>(plan.asked_tiles) <= 2500.0 * 45.0 / pairs);
  const auto frame = Compiler(room.settings).frame(stage);
  REQUIRE(frame);
  CHECK(frame->measure.optimal.left.left_tiles > 0);
}

TEST_CASE("a pupil whose blur would be too wide is taken smaller") {
  const Stage stage = cards::room();
  CompileSettings settings = cards::settings({-6.0, 0.0, 1.5}, Assignment::optimal);
  settings.projector = resized(settings.projector, 1024, 768);
  const EyeRoom room(stage, settings);
  const StackPlan plan = plan_of(room);
  REQUIRE_FALSE(plan.empty());
  CHECK(plan.pupil_m < usual_pupil_m);
  for (const StackTile& tile : plan.tiles) {
    for (const StackSpan& span : tile.spans) CHECK((span.width <= 27 && span.height <= 27));
  }
}

TEST_CASE("half of the far card is seen past the near one's edge: the share of the pupil that passes it") {
  // A near black half plane, its edge along y, before a far white one; focus on the far one.
  Stage stage = cards::room(false);
  stage.objects[0].drawables[0].finish = {};
  StagedObject near = stage.objects[0];
  near.drawables[0] = support::standing(support::rectangle({1.0, 1.0}), {{-0.5315, 0.0, -0.375}});
  near.drawables[0].finish.a = glm::dvec3(0.0);
  stage.objects.push_back(near);  // its edge stands straight before the left eye
  const EyeRoom room(stage, cards::settings({-1.0, 0.75}, Assignment::optimal));
  const StackPlan plan = plan_of(room);
  REQUIRE(plan.foci == 3);
  const StackTarget target(room.view, room.looks, plan, room.slices, 1, best_kernel());
  int compared = 0;
  for (std::size_t slot = 0; slot < plan.tiles.size(); ++slot) {
    const StackTile& tile = plan.tiles[slot];
    std::vector<float> seen;
    target.tile(slot, seen);
    for (int i = 0; i < tile_samples; ++i) {
      if ((tile.asked >> i & 1) == 0) continue;
      const double u = room.tile(tile.column * 8, tile.row * 8).x[i];
      // The ray at height h of the look u passes the near plane at h + (u - h f) z; it is free where that is positive.
      const double f = tile.focus_d[2], z = 0.375;
      const double h = -u * z / (1.0 - f * z) / 0.002;
      const double free = h <= -1.0 ? 1.0 : h >= 1.0 ? 0.0 : 0.5 - (h * std::sqrt(1.0 - h * h) + std::asin(h)) / M_PI;
      CHECK(seen[2 * tile_samples + static_cast<std::size_t>(i)] == doctest::Approx(free).epsilon(0.09));
      if (free > 0.05 && free < 0.95) ++compared;
    }
  }
  CHECK(compared > 100);
}

TEST_CASE("tracing back is the transpose of seeing") {
  const Stage stage = cards::room();
  const EyeRoom room(stage, cards::settings({-1.0, 0.0, 1.0}, Assignment::optimal));
  StackPlan plan = plan_of(room);
  for (StackTile& tile : plan.tiles) {  // the same optics everywhere, for within a tile alone it is exact
    tile.spans = plan.tiles.front().spans;
    tile.shares = plan.tiles.front().shares;
  }
  support::Chance chance(3);
  StackField light(plan.tiles.size() * 3 * tile_samples), cells(plan.tiles.size() * 5 * tile_samples);
  for (float& value : light) value = static_cast<float>(chance.between(0.0, 1.0));
  for (float& value : cells) value = static_cast<float>(chance.between(-1.0, 1.0));
  StackField seen(cells.size(), 0.0f), back(light.size(), 0.0f), portable(cells.size(), 0.0f);
  for (std::size_t slot = 0; slot < plan.tiles.size(); ++slot) {
    see_tile(best_kernel(), plan, light, slot, 1.0f, &seen[slot * 5 * tile_samples]);
    see_tile(portable_kernel, plan, light, slot, 1.0f, &portable[slot * 5 * tile_samples]);
    trace_back_tile(best_kernel(), plan, cells, slot, &back[slot * 3 * tile_samples]);
  }
  CHECK(product(seen, cells) == doctest::Approx(product(light, back)).epsilon(1e-5));
  CHECK(seen == portable);
}

TEST_CASE("two planes and no blur: the light that is missing is shared, what is too much is taken from both") {
  // Every focus sees x + y; the least squares from (a, b) with a small pull go half of the error each way.
  const StackPlan plan = pinhole_plan(2, 3);
  StackProblem problem;
  problem.linear.assign(3 * 2 * tile_samples, 0.25f);
  problem.most.assign(problem.linear.size(), 1.0f);
  problem.target.assign(3 * 3 * tile_samples, 0.0f);
  for (std::size_t i = 0; i < problem.target.size(); ++i) problem.target[i] = i < 3 * tile_samples ? 0.8f : 0.1f;
  const StackSolution solved = solve_stack(plan, problem, best_kernel(), {});
  CHECK(solved.change[0] == doctest::Approx(0.15).epsilon(0.01));
  CHECK(solved.change[tile_samples] == doctest::Approx(0.15).epsilon(0.01));
  CHECK(solved.change[2 * tile_samples] == doctest::Approx(-0.2).epsilon(0.01));
  CHECK(solved.linear.count == 3 * 3 * tile_samples);
  CHECK(solved.linear.sum == doctest::Approx(3.0 * tile_samples * (0.3 * 0.3 + 2 * 0.4 * 0.4)).epsilon(1e-5));
  CHECK(solved.optimal.sum < 1e-3 * solved.linear.sum);
  CHECK(solved.accepted_tiles == 3);
}

TEST_CASE("no light below zero, none above what may be shown") {
  const StackPlan plan = pinhole_plan(2, 1);
  StackProblem problem;
  problem.linear.assign(2 * tile_samples, 0.1f);
  problem.most.assign(2 * tile_samples, 0.3f);
  problem.target.assign(3 * tile_samples, 5.0f);
  const StackSolution bright = solve_stack(plan, problem, best_kernel(), {});
  for (const float change : bright.change) CHECK(change == doctest::Approx(0.2));
  std::fill(problem.target.begin(), problem.target.end(), -5.0f);
  const StackSolution dark = solve_stack(plan, problem, best_kernel(), {});
  for (const float change : dark.change) CHECK(change == doctest::Approx(-0.1));
  std::fill(problem.most.begin(), problem.most.end(), 0.05f);  // linear already shows more than may be
  std::fill(problem.target.begin(), problem.target.end(), 5.0f);
  const StackSolution full = solve_stack(plan, problem, best_kernel(), {});
  for (const float change : full.change) CHECK(change == 0.0f);
}

TEST_CASE("where nothing can be better the light stays as it was") {
  const StackPlan plan = pinhole_plan(3, 2);
  StackProblem problem;
  problem.linear.assign(2 * 3 * tile_samples, 0.25f);
  problem.most.assign(problem.linear.size(), 1.0f);
  problem.target.assign(2 * 5 * tile_samples, 0.75f);
  const StackSolution solved = solve_stack(plan, problem, best_kernel(), {});
  for (const float change : solved.change) CHECK(change == 0.0f);
  CHECK(solved.accepted_tiles == 0);
  CHECK(solved.optimal.sum == solved.linear.sum);
}
