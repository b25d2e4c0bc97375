#include "core/compile/look_grid.h"

#include <doctest/doctest.h>

#include <memory>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

using namespace focalstage;

namespace {

Drawable drawable_of(Mesh mesh) { return {std::make_shared<const Mesh>(std::move(mesh)), glm::dmat4(1.0), {}}; }

/// Loose triangles all around; with `behind`, many of them reach past the viewer.
Mesh random_triangles(std::mt19937& chance, int count, bool behind) {
  std::uniform_real_distribution<double> aside(-1.0, 1.0), away(behind ? -0.5 : 0.5, 2.0), near(-0.3, 0.3);
  Mesh mesh;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
    const glm::dvec3 middle(aside(chance), aside(chance), -away(chance));
    for (int corner = 0; corner < 3; ++corner) {
      mesh.positions_m.push_back(middle + glm::dvec3(near(chance), near(chance), behind ? near(chance) : 0.0));
    }
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return mesh;
}

/// The nearest triangle along (x, y, -1), by Moeller and Trumbore's intersection: shares nothing with the grid.
std::int32_t nearest(const std::vector<Drawable>& drawables, const glm::dvec2& look, double nearest_m) {
  const glm::dvec3 along(look, -1.0);
  std::int32_t met = -1;
  double best_m = 1e300;
  for (std::size_t d = 0; d < drawables.size(); ++d) {
    const Mesh& mesh = *drawables[d].mesh;
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec3 a = mesh.positions_m[t.x];
      const glm::dvec3 ab = mesh.positions_m[t.y] - a, ac = mesh.positions_m[t.z] - a;
      const glm::dvec3 p = glm::cross(along, ac);
      const double scale = glm::dot(ab, p);
      const double u = glm::dot(-a, p) / scale;
      const glm::dvec3 q = glm::cross(-a, ab);
      const double v = glm::dot(along, q) / scale;
      const double depth_m = glm::dot(ac, q) / scale;
      if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0) || !(depth_m >= nearest_m) || depth_m >= best_m) continue;
      best_m = depth_m;
      met = static_cast<std::int32_t>(d);
    }
  }
  return met;
}

}  // namespace

TEST_CASE("a grid of looks meets what each look alone would meet") {
  std::mt19937 chance(7);
  constexpr int side = 40;
  for (const bool behind : {false, true}) {
    const std::vector<Drawable> drawables{drawable_of(random_triangles(chance, 150, behind)),
                                          drawable_of(random_triangles(chance, 150, behind))};
    LookGrid grid;
    grid.lay({{&drawables[0]}, {&drawables[1]}}, {}, 0.016, side);
    REQUIRE(!grid.empty());
    int wrong = 0, met = 0;
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) {
        const std::int32_t expected = nearest(drawables, grid.look(column, row), 0.016);
        met += expected >= 0 ? 1 : 0;
        wrong += grid.met(column, row) != expected ? 1 : 0;
      }
    }
    CHECK(met > side * side / 4);
    CHECK(wrong == 0);
  }
}

TEST_CASE("looks cover the drawables from edge to edge, half a step in") {
  // A square from -0.5 to 0.5 at 1 m: in the tangent plane the same numbers.
  Mesh square;
  square.positions_m = {{-0.5, -0.5, -1}, {0.5, -0.5, -1}, {0.5, 0.5, -1}, {-0.5, 0.5, -1}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Drawable drawable = drawable_of(square);
  LookGrid grid;
  grid.lay({{&drawable}}, {}, 0.016, 10);
  CHECK(grid.look(0, 9).x == doctest::Approx(-0.45));
  CHECK(grid.look(0, 9).y == doctest::Approx(0.45));
  for (int i = 0; i < 100; ++i) CHECK(grid.met(i % 10, i / 10) == 0);
  grid.lay({}, {}, 0.016, 10);
  CHECK(grid.empty());
}
