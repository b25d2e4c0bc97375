#include "core/mesh/measure.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <limits>

#include <glm/geometric.hpp>

#include "core/mesh/primitives.h"

using namespace focalstage;

TEST_CASE("a mesh with a wrong index, list or number is named") {
  CHECK(check_mesh(Mesh{}).ok());
  Mesh mesh = make_plane({1, 1});
  CHECK(check_mesh(mesh).ok());

  Mesh beyond = mesh;
  beyond.triangles[1].z = 4;
  REQUIRE_FALSE(check_mesh(beyond).ok());
  CHECK(check_mesh(beyond).fault().code == "mesh.invalid");
  CHECK(check_mesh(beyond).fault().message == "triangle 1 names a vertex beyond the 4 there are");

  Mesh short_list = mesh;
  short_list.uvs.pop_back();
  CHECK_FALSE(check_mesh(short_list).ok());

  Mesh infinite = mesh;
  infinite.positions_m[2].y = std::numeric_limits<double>::infinity();
  REQUIRE_FALSE(check_mesh(infinite).ok());
  CHECK(check_mesh(infinite).fault().message == "vertex 2 is not finite");
  Mesh nan = mesh;
  nan.normals[3].z = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(check_mesh(nan).ok());
}

TEST_CASE("closed means that every edge is shared by two triangles that run it both ways") {
  Mesh box = make_box({1, 1, 1});
  CHECK(is_closed(box));
  Mesh turned = box;
  std::swap(turned.triangles[0].x, turned.triangles[0].y);
  CHECK_FALSE(is_closed(turned));
  Mesh doubled = box;
  doubled.triangles.push_back(doubled.triangles[0]);
  CHECK_FALSE(is_closed(doubled));
  box.triangles.pop_back();
  CHECK_FALSE(is_closed(box));
  CHECK_FALSE(is_closed(make_plane({1, 1})));
  CHECK_FALSE(is_closed(Mesh{}));
  Mesh needled = make_box({1, 1, 1});
  needled.triangles.emplace_back(0, 1, 1);  // without area: it opens nothing
  CHECK(is_closed(needled));
}

TEST_CASE("bounds are those of what triangles use; 0 and -0 weld") {
  Mesh mesh;
  for (const glm::dvec3& p :
       {glm::dvec3(0.0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(100.0), -glm::dvec3(0.0)}) {
    mesh.positions_m.push_back(p);
  }
  mesh.triangles = {{0, 1, 2}};
  const Bounds bounds = mesh_bounds(mesh);
  CHECK(bounds.max_m == glm::dvec3(1, 1, 0));
  const Bounds nothing = mesh_bounds(Mesh{});
  CHECK(nothing.empty());
  CHECK(glm::length(nothing.size_m()) == 0.0);
  CHECK(welded_indices(mesh) == std::vector<std::uint32_t>{0, 1, 2, 3, 0});
}
