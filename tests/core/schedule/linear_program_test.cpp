#include "core/schedule/linear_program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>

#include <doctest/doctest.h>

using namespace focalstage;

namespace {

LinearProgram program(std::vector<double> cost) {
  LinearProgram result;
  result.ridge.assign(cost.size(), 0.0);
  result.at_most.width = result.equal.width = cost.size();
  result.cost = std::move(cost);
  return result;
}

void at_most(LinearProgram& program, std::initializer_list<double> row, double most) {
  std::copy(row.begin(), row.end(), program.at_most.add().begin());
  program.most.push_back(most);
}

void equal(LinearProgram& program, std::initializer_list<double> row, double exactly) {
  std::copy(row.begin(), row.end(), program.equal.add().begin());
  program.exactly.push_back(exactly);
}

/// Numbers between -1 and 1, always the same.
class Noise {
 public:
  double next() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) / 4503599627370496.0 - 1.0;
  }

 private:
  std::uint64_t state_ = 7;
};

}  // namespace

TEST_CASE("the corner of a textbook's polygon") {
  // Most of 3x + 2y with x + y <= 4, x + 3y <= 6, x <= 3, both from 0: at (3, 1).
  LinearProgram polygon = program({-3.0, -2.0});
  at_most(polygon, {1.0, 1.0}, 4.0);
  at_most(polygon, {1.0, 3.0}, 6.0);
  at_most(polygon, {1.0, 0.0}, 3.0);
  at_most(polygon, {-1.0, 0.0}, 0.0);
  at_most(polygon, {0.0, -1.0}, 0.0);
  const auto best = least_cost(polygon);
  REQUIRE(best);
  CHECK((*best)[0] == doctest::Approx(3.0).epsilon(1e-6));
  CHECK((*best)[1] == doctest::Approx(1.0).epsilon(1e-6));
}

TEST_CASE("free unknowns and an equality: the straight line nearest to three points") {
  // Chebyshev's line through (0,0), (1,2), (2,1): slope 1/2, worst distance 3/4. Here with its value at 3 given as
  // well: a + 3b = 2, so e >= |a|, |a + b - 2|, |a + 2b - 1|; with a = 2 - 3b: e >= |2 - 3b|, 2b, |1 - b|: b = 0.4, e =
  // 0.8.
  for (const bool held : {false, true}) {
    LinearProgram line = program({0.0, 0.0, 1.0});
    const double points[3][2] = {{0.0, 0.0}, {1.0, 2.0}, {2.0, 1.0}};
    for (const auto& [x, y] : points) {
      at_most(line, {1.0, x, -1.0}, y);
      at_most(line, {-1.0, -x, -1.0}, -y);
    }
    if (held) equal(line, {1.0, 3.0, 0.0}, 2.0);
    const auto best = least_cost(line);
    REQUIRE(best);
    CHECK((*best)[1] == doctest::Approx(held ? 0.4 : 0.5).epsilon(1e-6));
    CHECK((*best)[2] == doctest::Approx(held ? 0.8 : 0.75).epsilon(1e-6));
  }
}

TEST_CASE("a ridge makes the cost a bowl") {
  for (const double most : {0.25, 5.0}) {
    LinearProgram bowl = program({-1.0});  // x^2 / 2 - x: least at 1
    bowl.ridge = {1.0};
    at_most(bowl, {1.0}, most);
    const auto best = least_cost(bowl);
    REQUIRE(best);
    CHECK((*best)[0] == doctest::Approx(std::min(most, 1.0)).epsilon(1e-6));
  }
}

TEST_CASE("what cannot be is nothing, within the steps") {
  LinearProgram torn = program({1.0});
  at_most(torn, {1.0}, -1.0);
  at_most(torn, {-1.0}, -1.0);
  CHECK_FALSE(least_cost(torn));

  LinearProgram endless = program({-1.0});
  at_most(endless, {-1.0}, 0.0);
  CHECK_FALSE(least_cost(endless));

  LinearProgram sound = program({1.0});
  at_most(sound, {-1.0}, 0.0);
  CHECK(least_cost(sound));
  CHECK_FALSE(least_cost(sound, 1));

  LinearProgram no_number = program({1.0});
  at_most(no_number, {std::nan("")}, 0.0);
  CHECK_FALSE(least_cost(no_number));
}

TEST_CASE("random polygons: no corner is cheaper, and no row is broken") {
  Noise noise;
  for (int round = 0; round < 200; ++round) {
    // Half planes about the origin, closed by a box: its least corner by trying all pairs of sides.
    const double cx = noise.next();
    const double cy = noise.next();
    LinearProgram polygon = program({cx, cy});
    std::vector<std::array<double, 3>> sides{{1, 0, 2}, {-1, 0, 2}, {0, 1, 2}, {0, -1, 2}};
    for (int i = 0; i < 8; ++i) sides.push_back({noise.next(), noise.next(), 0.3 + 0.3 * noise.next()});
    for (const auto& [a, b, most] : sides) at_most(polygon, {a, b}, most);
    double least = 1e9;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const auto& [a, b, e] = sides[i];
        const auto& [c, d, f] = sides[j];
        const double area = a * d - b * c;
        const double x = (e * d - b * f) / area;
        const double y = (a * f - e * c) / area;
        const bool inside = std::all_of(sides.begin(), sides.end(),
                                        [&](const auto& side) { return side[0] * x + side[1] * y <= side[2] + 1e-9; });
        if (std::isfinite(x) && std::isfinite(y) && inside) least = std::min(least, cx * x + cy * y);
      }
    }
    const auto best = least_cost(polygon);
    REQUIRE(best);
    CHECK(cx * (*best)[0] + cy * (*best)[1] == doctest::Approx(least).epsilon(1e-6));
    for (const auto& side : sides) CHECK(side[0] * (*best)[0] + side[1] * (*best)[1] <= side[2] + 1e-6);
  }
}
