#include "core/process/texture_map.h"

#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/mesh/measure.h"
#include "core/process/process.h"
#include "tests/core/process/meshes.h"

namespace focalstage {
namespace {

using test::grid;
using test::plain_box;

Mesh mapped(const Mesh& mesh, const ProcessKind& step, double scale = 1.0,
            const glm::dmat4& thing_from_mesh = glm::dmat4(1.0)) {
  Result<Mesh> made = processed(mesh, {{step, {}}}, scale, thing_from_mesh);
  REQUIRE_MESSAGE(made, describe(made ? Fault{} : made.fault()));
  CHECK(check_mesh(*made).ok());
  REQUIRE(made->uvs.size() == made->positions_m.size());
  return *std::move(made);
}

Mesh without_uv(Mesh mesh) {
  mesh.uvs.clear();
  return mesh;
}

/// The pixel of a point in a projector's own axes, told by the ray through it in place of a quotient.
glm::dvec2 pixel_by_angle(const UvProjectorStep& lens, const glm::dvec3& p) {
  return {lens.cx_px + lens.fx_px * std::tan(std::atan2(p.x, -p.z)),
          lens.cy_px - lens.fy_px * std::tan(std::atan2(p.y, -p.z))};
}

}  // namespace

TEST_CASE("a plane's picture is fitted from border to border") {
  const Mesh wave = without_uv(grid(8, [](glm::dvec2 at) { return 0.2 * at.x; }));
  const Mesh made = mapped(wave, UvPlaneStep{});
  for (std::size_t i = 0; i < made.uvs.size(); ++i) {
    CHECK(made.uvs[i].x == doctest::Approx(made.positions_m[i].x));
    CHECK(made.uvs[i].y == doctest::Approx(made.positions_m[i].y));
  }
  CHECK(made.triangles == wave.triangles);
}

TEST_CASE("a picture of a size lies where its plane stands, in the room's metres and the thing's axes") {
  // Turned about the upright: the picture's u runs along the thing's -Z. The mesh is in millimetres, in a node that is
  // a metre up.
  UvPlaneStep step;
  step.pose.rotation = glm::angleAxis(std::acos(0.0), glm::dvec3(0.0, 1.0, 0.0));
  step.pose.position_m = {0.0, 1.2, 0.3};
  step.size_m = glm::dvec2(0.8, 0.4);
  const Mesh box = plain_box(500.0);
  const glm::dmat4 up = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 1000.0, 0.0));
  const Mesh made = mapped(box, step, 1e-3, up);
  for (std::size_t i = 0; i < made.uvs.size(); ++i) {
    const glm::dvec3 room_m = 1e-3 * (box.positions_m[i] + glm::dvec3(0.0, 1000.0, 0.0));
    CHECK(made.uvs[i].x == doctest::Approx(0.5 - (room_m.z - 0.3) / 0.8));
    CHECK(made.uvs[i].y == doctest::Approx(0.5 + (room_m.y - 1.2) / 0.4));
  }
}

TEST_CASE("what a plane sees edge-on has no width to fit") {
  UvPlaneStep step;
  step.pose.rotation = glm::angleAxis(std::acos(0.0), glm::dvec3(0.0, 1.0, 0.0));
  const auto made = processed(without_uv(make_plane({1, 1})), {{step, {}}});
  REQUIRE(!made);
  CHECK(made.fault().code == "process.edge-on");
  CHECK(made.fault().where == "/0/rotation_xyzw");
  step.size_m = glm::dvec2(1.0);
  CHECK(processed(without_uv(make_plane({1, 1})), {{step, {}}}).ok());
}

TEST_CASE("a projector's picture is right within a quarter of a pixel all over a slanted wall of two triangles") {
  UvProjectorStep lens;
  lens.pose.position_m = {0.4, 0.1, 0.9};
  lens.pose.rotation = glm::angleAxis(0.7, glm::normalize(glm::dvec3(0.2, 1.0, 0.1)));
  lens.cx_px = 500.0;
  Mesh wall = without_uv(make_plane({1.6, 1.2}));
  wall.colors.assign(wall.positions_m.size(), glm::dvec3(0.5));
  const Mesh made = mapped(wall, lens);
  CHECK(made.triangles.size() > 100);
  CHECK(made.triangles.size() < 20000);
  CHECK(mesh_area_m2(made) == doctest::Approx(1.6 * 1.2));
  CHECK(made.colors.size() == made.positions_m.size());
  CHECK(made.normals.size() == made.positions_m.size());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share;
  const Rigid projector_from_room = lens.pose.inverse();
  double worst_px = 0.0, coarse_px = 0.0;
  int inside = 0;
  for (const glm::uvec3& t : made.triangles) {
    glm::dvec3 w(share(random), share(random), share(random));
    w /= w.x + w.y + w.z;
    const glm::dvec3 at = made.positions_m[t.x] * w.x + made.positions_m[t.y] * w.y + made.positions_m[t.z] * w.z;
    const glm::dvec2 uv = made.uvs[t.x] * w.x + made.uvs[t.y] * w.y + made.uvs[t.z] * w.z;
    const glm::dvec2 truth_px = pixel_by_angle(lens, projector_from_room.point(at));
    if (truth_px.x < 0 || truth_px.y < 0 || truth_px.x > lens.width_px || truth_px.y > lens.height_px) continue;
    ++inside;
    worst_px = std::max(worst_px, glm::distance(truth_px, glm::dvec2(uv.x, 1.0 - uv.y) * glm::dvec2(1024, 768)));
  }
  CHECK(inside > 100);
  CHECK(worst_px < most_stray_px);
  // As two triangles it would have been off by many pixels.
  const auto corner_px = [&](glm::dvec2 at) { return pixel_by_angle(lens, projector_from_room.point({at, 0.0})); };
  coarse_px = glm::distance(corner_px({0, 0}), 0.5 * (corner_px({-0.8, 0.6}) + corner_px({0.8, -0.6})));
  CHECK(coarse_px > 20.0);
}

TEST_CASE("cutting leaves no gap: a closed body stays closed") {
  UvProjectorStep lens;
  lens.pose.position_m = {0.2, 0.1, 0.8};
  const Mesh made = mapped(plain_box(), lens);
  CHECK(made.triangles.size() > 12);
  CHECK(is_closed(made));
  CHECK(enclosed_volume_m3(made) == doctest::Approx(1.0));
}

TEST_CASE("what reaches behind the projector has no pixel there") {
  UvProjectorStep lens;  // in the middle of the box
  const auto made = processed(plain_box(), {{FlipStep{}, {}}, {lens, {}}});
  REQUIRE(!made);
  CHECK(made.fault().code == "process.behind-projector");
  CHECK(made.fault().where == "/1/position_m");
}

TEST_CASE("a step for one place is not taken for another") {
  const auto wall = std::make_shared<const Mesh>(without_uv(make_plane({1, 1})));
  UvPlaneStep step;
  step.size_m = glm::dvec2(1.0);
  const std::vector<ProcessStep> steps{{step, {}}};
  const glm::dmat4 aside = glm::translate(glm::dmat4(1.0), glm::dvec3(0.25, 0.0, 0.0));
  const auto here = processed_once(wall, steps, 1.0);
  const auto there = processed_once(wall, steps, 1.0, aside);
  const auto larger = processed_once(wall, steps, 2.0);
  REQUIRE((here && there && larger));
  CHECK((*there)->uvs[0].x == doctest::Approx((*here)->uvs[0].x + 0.25));
  CHECK((*larger)->uvs[0].x == doctest::Approx(-0.5));
  CHECK(processed_once(wall, steps, 1.0)->get() == here->get());
}

}  // namespace focalstage
