#include "core/reference/sight.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <utility>

#include <glm/common.hpp>

using namespace focalstage;

namespace {

/// A square of two triangles at `depth_m`, half as wide as `half_m`.
std::vector<SeenTriangle> square(double depth_m, double half_m) {
  const glm::dvec3 a{-half_m, -half_m, -depth_m}, b{half_m, -half_m, -depth_m};
  const glm::dvec3 c{half_m, half_m, -depth_m}, d{-half_m, half_m, -depth_m};
  return {{a, b, c}, {a, c, d}};
}

}  // namespace

TEST_CASE("the nearest of two squares is seen, from either side of its triangles") {
  std::vector<SeenTriangle> triangles = square(2.0, 1.0);
  for (SeenTriangle near : square(1.0, 0.25)) {
    std::swap(near[1], near[2]);
    triangles.push_back(near);
  }
  const Result<Sight> sight = Sight::of(triangles, 0.1);
  REQUIRE(sight);
  const auto through_near = sight->nearest({0.1, 0.2});
  REQUIRE(through_near);
  CHECK(through_near->depth_m == doctest::Approx(1.0).epsilon(1e-15));
  CHECK(through_near->triangle == 3);
  const auto beside_near = sight->nearest({0.3, 0.2});
  REQUIRE(beside_near);
  CHECK(beside_near->depth_m == doctest::Approx(2.0).epsilon(1e-15));
  CHECK(beside_near->triangle == 0);
  CHECK_FALSE(sight->nearest({0.6, 0.0}));  // both end at 0.5
}

TEST_CASE("what is nearer than the near plane or behind is not seen") {
  std::vector<SeenTriangle> triangles = square(0.05, 1.0);
  for (const SeenTriangle& behind : square(-1.0, 1.0)) triangles.push_back(behind);
  const Result<Sight> sight = Sight::of(triangles, 0.1);
  REQUIRE(sight);
  CHECK_FALSE(sight->nearest({0.1, 0.2}));
}

TEST_CASE("of two faces in one place the first is seen, wherever the tree starts") {
  std::vector<SeenTriangle> triangles = square(1.0, 1.0);
  for (int copy = 0; copy < 20; ++copy) {
    for (const SeenTriangle& same : square(1.0, 1.0)) triangles.push_back(same);
  }
  const Result<Sight> sight = Sight::of(triangles, 0.1);
  REQUIRE(sight);
  CHECK(sight->nearest({0.31, 0.2})->triangle == 0);
  CHECK(sight->nearest({0.2, 0.31})->triangle == 1);
}

TEST_CASE("the corners' shares give back the point") {
  const SeenTriangle corners{glm::dvec3(-1, -1, -2), glm::dvec3(3, -1, -4), glm::dvec3(0, 2, -3)};
  const Result<Sight> sight = Sight::of({corners}, 0.1);
  REQUIRE(sight);
  const auto seen = sight->nearest({0.1, 0.05});
  REQUIRE(seen);
  const glm::dvec3 point = seen->shares.x * corners[0] + seen->shares.y * corners[1] + seen->shares.z * corners[2];
  CHECK(point.x == doctest::Approx(0.1 * seen->depth_m).epsilon(1e-14));
  CHECK(point.y == doctest::Approx(0.05 * seen->depth_m).epsilon(1e-14));
  CHECK(point.z == doctest::Approx(-seen->depth_m).epsilon(1e-14));
}

TEST_CASE("no look slips between neighbours: at the seams, the corners and anywhere") {
  constexpr int cells = 40;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> jitter(-0.4, 0.4);
  std::vector<glm::dvec3> grid;
  for (int y = 0; y <= cells; ++y) {
    for (int x = 0; x <= cells; ++x) {
      const bool inner = x > 0 && x < cells && y > 0 && y < cells;
      const glm::dvec2 at(x + (inner ? jitter(random) : 0.0), y + (inner ? jitter(random) : 0.0));
      grid.emplace_back(at * (2.0 / cells) - 1.0, -2.0 + 0.2 * jitter(random));
    }
  }
  std::vector<SeenTriangle> triangles;
  for (std::size_t y = 0; y < cells; ++y) {
    for (std::size_t x = 0; x < cells; ++x) {
      const std::size_t i = y * (cells + 1) + x;
      triangles.push_back({grid[i], grid[i + 1], grid[i + cells + 2]});
      triangles.push_back({grid[i], grid[i + cells + 2], grid[i + cells + 1]});
    }
  }
  const Result<Sight> sight = Sight::of(triangles, 0.1);
  REQUIRE(sight);
  int missed = 0;
  std::uniform_real_distribution<double> anywhere(-0.4, 0.4), along(0.0, 1.0);
  for (int i = 0; i < 100'000; ++i) {
    const SeenTriangle& corners = triangles[static_cast<std::size_t>(random() % triangles.size())];
    const glm::dvec3 seam = glm::mix(corners[0], corners[1], i % 3 == 0 ? 0.0 : along(random));
    const glm::dvec2 look = i % 2 == 0 ? glm::dvec2(seam) / -seam.z : glm::dvec2(anywhere(random), anywhere(random));
    if (std::abs(look.x) < 0.4 && std::abs(look.y) < 0.4 && !sight->nearest(look)) ++missed;
  }
  CHECK(missed == 0);
}
