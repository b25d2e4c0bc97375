#include "editor/tools/known_bounds.h"

#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/stage/primitive_cache.h"

using namespace focalstage;

TEST_CASE("bounds are a mesh's own, also when another mesh comes to its address") {
  for (int size = 1; size <= 5; ++size) {
    const auto mesh = std::make_shared<const Mesh>(**primitive_mesh(BoxMesh{glm::dvec3(size)}));
    CHECK(known_bounds(mesh).max_m.x == doctest::Approx(0.5 * size));
    CHECK(known_bounds(mesh).max_m.x == doctest::Approx(0.5 * size));
  }
}

TEST_CASE("rough bounds hold all that a thing is, wherever it stands") {
  const glm::dmat4 turned = glm::rotate(glm::translate(glm::dmat4(1.0), {1.0, 0.0, 0.0}), 0.6, {0.0, 1.0, 0.0});
  const std::vector<Drawable> drawables{{*primitive_mesh(BoxMesh{{0.2, 0.4, 0.6}}), turned, {}}};
  const Bounds rough = rough_world_bounds(drawables);
  // A box is its own corners: cos 0.6 * 0.1 + sin 0.6 * 0.3 to each side.
  CHECK(rough.max_m.x == doctest::Approx(1.0 + 0.1 * 0.825336 + 0.3 * 0.564642));
  CHECK(rough.min_m.y == doctest::Approx(-0.2));
  CHECK(rough_world_bounds({}).empty());
}
