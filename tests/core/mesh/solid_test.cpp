#include "core/mesh/solid.h"

#include <doctest/doctest.h>

#include <utility>

#include "core/mesh/primitives.h"

using namespace focalstage;

namespace {

Mesh inside_out(Mesh mesh) {
  for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  return mesh;
}

Mesh both(Mesh a, const Mesh& b, const glm::dvec3& offset) {
  const auto first = static_cast<unsigned>(a.positions_m.size());
  for (const glm::dvec3& p : b.positions_m) a.positions_m.push_back(p + offset);
  for (const glm::uvec3& t : b.triangles) a.triangles.push_back(t + first);
  a.normals.clear();
  a.uvs.clear();
  return a;
}

}  // namespace

TEST_CASE("a box and two boxes apart are solid") {
  const Mesh box = make_box({1, 1, 1});
  CHECK(is_solid(box));
  CHECK(is_solid(both(box, box, {3, 0, 0})));
}

TEST_CASE("open, empty, inside out, or one part inside out is not") {
  const Mesh box = make_box({1, 1, 1});
  CHECK_FALSE(is_solid(Mesh{}));
  CHECK_FALSE(is_solid(make_plane({1, 1})));
  CHECK_FALSE(is_solid(inside_out(box)));
  CHECK_FALSE(is_solid(both(make_box({2, 2, 2}), inside_out(box), {5, 0, 0})));
}
