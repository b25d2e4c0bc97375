#include "io/assets/polygons.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include <glm/geometric.hpp>

using namespace focalstage;

namespace {

using Corners = std::vector<glm::dvec3>;

/// Sum of the triangles' areas along +Z, negative ones counting as such.
double area(const Corners& corners, const std::vector<glm::uvec3>& triangles) {
  double sum = 0.0;
  for (const glm::uvec3& t : triangles) {
    const double each = 0.5 * glm::cross(corners[t.y] - corners[t.x], corners[t.z] - corners[t.x]).z;
    CHECK(each >= -1e-12);
    sum += each;
  }
  return sum;
}

std::vector<glm::uvec3> cut(const Corners& corners) {
  PolygonCutter cutter;
  std::vector<glm::uvec3> triangles;
  REQUIRE(cutter.cut(corners, triangles));
  CHECK(cutter.crossed() == 0);
  CHECK(triangles.size() == corners.size() - 2);
  return triangles;
}

}  // namespace

TEST_CASE("a convex polygon is a fan from its first corner") {
  const Corners square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  CHECK(cut(square) == std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("a reflex corner is not cut across, wherever the polygon begins") {
  // An arrowhead whose notch at (1, 0.5) a fan from the wrong corner would fill.
  const Corners arrow{{0, 0, 0}, {1, 0.5, 0}, {2, 0, 0}, {1, 3, 0}};
  for (std::size_t first = 0; first < 4; ++first) {
    Corners turned;
    for (std::size_t i = 0; i < 4; ++i) turned.push_back(arrow[(first + i) % 4]);
    CHECK(area(turned, cut(turned)) == doctest::Approx(2.5));  // 3 less the notch's 0.5
  }
}

TEST_CASE("a comb with many teeth is covered once, in any plane") {
  Corners comb{{0, 0, 0}, {20, 0, 0}};
  for (int i = 20; i >= 0; --i) comb.emplace_back(i, i % 2 == 0 ? 3 : 1, 0);
  // Twenty trapezoids of mean height 2.
  CHECK(area(comb, cut(comb)) == doctest::Approx(40.0));
  for (glm::dvec3& p : comb) p = {p.z + 1e6, p.x, p.y};  // the same, seen along +X and far away
  double along_x = 0.0;
  for (const glm::uvec3& t : cut(comb)) along_x += 0.5 * glm::cross(comb[t.y] - comb[t.x], comb[t.z] - comb[t.x]).x;
  CHECK(along_x == doctest::Approx(40.0));
}

TEST_CASE("star-shaped polygons drawn at random keep their area") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> radius(0.2, 2.0);
  for (int round = 0; round < 200; ++round) {
    Corners star;
    const int count = 4 + round % 30;
    for (int i = 0; i < count; ++i) {
      const double angle = 6.283185307179586 * i / count;
      const double r = radius(random);
      star.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    }
    double expected = 0.0;
    for (std::size_t i = 0; i < star.size(); ++i) expected += 0.5 * glm::cross(star[i], star[(i + 1) % star.size()]).z;
    CHECK(area(star, cut(star)) == doctest::Approx(expected).epsilon(1e-12));
  }
}

TEST_CASE("a polygon that crosses itself is counted, one without area is not") {
  PolygonCutter cutter;
  std::vector<glm::uvec3> triangles;
  const Corners bow{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1, 0}};
  REQUIRE(cutter.cut(bow, triangles));
  CHECK(triangles.size() == 2);
  CHECK(cutter.crossed() == 1);
  const Corners line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  triangles.clear();
  REQUIRE(cutter.cut(line, triangles));
  CHECK(triangles.size() == 2);
  CHECK(cutter.crossed() == 1);
}

TEST_CASE("work on monstrous polygons ends") {
  Corners zigzag;
  for (int i = 0; i < 60000; ++i) zigzag.emplace_back(i, i % 2, 0);
  for (int i = 60000; i-- > 0;) zigzag.emplace_back(i, i % 2 + 2, 0);
  PolygonCutter cutter;
  std::vector<glm::uvec3> triangles;
  while (cutter.cut(zigzag, triangles)) triangles.clear();
  CHECK(triangles.empty());
}
