#include "core/stage/texture_maps.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/mesh/primitives.h"
#include "core/process/process.h"

namespace focalstage {
namespace {

/// A thing of one mesh, standing there.
std::vector<Drawable> stood(Mesh mesh, const Rigid& world_from_thing, double scale = 1.0) {
  glm::dmat4 matrix = world_from_thing.matrix();
  for (int k = 0; k < 3; ++k) matrix[k] *= scale;
  return {{std::make_shared<const Mesh>(std::move(mesh)), matrix, {}}};
}

Rigid somewhere() { return {{1.0, 0.5, -2.0}, glm::angleAxis(0.6, glm::normalize(glm::dvec3(0.1, 1.0, 0.0)))}; }

}  // namespace

TEST_CASE("a sheet has its picture from border to border, upright as it stands") {
  const Rigid pose = somewhere();
  const Mesh plane = make_plane({1.6, 0.9});
  const auto drawables = stood(plane, pose, 0.5);
  const UvPlaneStep step = facing_plane(drawables, pose, {0, 0, 0});
  const auto made = processed(plane, {{step, {}}}, 0.5);
  REQUIRE(made);
  glm::dvec2 low(9.0), high(-9.0);
  for (std::size_t i = 0; i < plane.uvs.size(); ++i) {
    low = glm::min(low, made->uvs[i]);
    high = glm::max(high, made->uvs[i]);
    // The room's up is nearly the sheet's, so that the picture is turned by a few degrees at the most.
    CHECK(glm::distance(made->uvs[i], plane.uvs[i]) < 0.2);
  }
  CHECK(glm::distance(low, glm::dvec2(0.0)) < 1e-9);
  CHECK(glm::distance(high, glm::dvec2(1.0)) < 1e-9);
  // Its plane looks where the sheet does.
  CHECK(glm::dot(step.pose.rotation * glm::dvec3(0, 0, 1), glm::dvec3(0, 0, 1)) == doctest::Approx(1.0));
}

TEST_CASE("a body faces no side: its picture is towards who sees it") {
  const Rigid pose = somewhere();
  const UvPlaneStep step = facing_plane(stood(make_box({1, 1, 1}), pose), pose, {0, 0, 0});
  const glm::dvec3 normal = pose.rotation * (step.pose.rotation * glm::dvec3(0, 0, 1));
  CHECK(glm::dot(normal, glm::normalize(-pose.position_m)) == doctest::Approx(1.0));
  REQUIRE(step.size_m);
  CHECK(std::min(step.size_m->x, step.size_m->y) > 1.0);  // a box seen askew
  CHECK(std::max(step.size_m->x, step.size_m->y) < std::sqrt(3.0));
}

TEST_CASE("a floor, and a thing without extent, still have a plane") {
  const Rigid flat{{0, -1, 0}, glm::angleAxis(-std::acos(0.0), glm::dvec3(1, 0, 0))};
  const UvPlaneStep floor = facing_plane(stood(make_plane({2, 3}), flat), flat, {0, 0, 0});
  REQUIRE(floor.size_m);
  CHECK(floor.size_m->x == doctest::Approx(2.0));
  CHECK(floor.size_m->y == doctest::Approx(3.0));
  Mesh point;
  point.positions_m.assign(3, glm::dvec3(0.0));
  point.triangles = {{0, 1, 2}};
  CHECK_FALSE(facing_plane(stood(point, Rigid{}), Rigid{}, {0, 0, 0}).size_m);
}

TEST_CASE("what a projector throws stays on the thing wherever both go") {
  Projector projector;
  projector.pose = {{0.3, 0.2, 1.0}, glm::angleAxis(0.2, glm::dvec3(0, 1, 0))};
  projector.cx_px = 500.0;
  const Rigid pose = somewhere();
  const UvProjectorStep step = thrown_by(projector, pose);
  const Rigid back = pose * step.pose;
  CHECK(glm::distance(back.position_m, projector.pose.position_m) < 1e-12);
  CHECK(std::abs(glm::dot(back.rotation, projector.pose.rotation)) == doctest::Approx(1.0));
  CHECK(step.cx_px == 500.0);
}

}  // namespace focalstage
