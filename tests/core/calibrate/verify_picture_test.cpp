#include "core/calibrate/verify_picture.h"

#include <doctest/doctest.h>

#include <memory>

#include "core/calibrate/calibrated_edits.h"
#include "tests/core/calibrate/own_optics.h"

using namespace focalstage;

namespace {

StagedSurface surface_of(Mesh mesh) {
  StagedSurface surface;
  surface.drawables.push_back({std::make_shared<const Mesh>(std::move(mesh)), glm::dmat4(1.0), {}});
  return surface;
}

/// A box of six faces about (0, 0, -2), a metre wide.
Mesh box() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions_m.emplace_back((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, ((i >> 2) & 1) - 2.5);
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

}  // namespace

TEST_CASE("a box has twelve edges and no diagonals; a flat sheet its rim") {
  CHECK(model_edges({surface_of(box())}, {0, 0, 0}).size() == 12);
  Mesh sheet;
  sheet.positions_m = {{-1, -1, -2}, {1, -1, -2}, {1, 1, -2}, {-1, 1, -2}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  CHECK(model_edges({surface_of(sheet)}, {0, 0, 0}).size() == 4);
  sheet.triangles = {{0, 1, 2}, {0, 3, 2}};  // one wound the other way: an outline, as it is drawn
  CHECK(model_edges({surface_of(sheet)}, {0, 0, 0}).size() == 5);
}

TEST_CASE("what is smooth is drawn by its outline") {
  // A tube of 36 sides along Y: folds of 10 degrees.
  Mesh tube;
  for (int i = 0; i < 36; ++i) {
    const double turn = i * std::numbers::pi / 18.0;
    for (const double y : {-0.5, 0.5}) tube.positions_m.emplace_back(0.3 * std::sin(turn), y, 0.3 * std::cos(turn) - 2);
  }
  for (std::uint32_t i = 0; i < 36; ++i) {
    const std::uint32_t a = 2 * i;
    const std::uint32_t b = 2 * ((i + 1) % 36);
    tube.triangles.emplace_back(a, b, a + 1);
    tube.triangles.emplace_back(b, b + 1, a + 1);
  }
  int along = 0;
  for (const auto& [a, b] : model_edges({surface_of(tube)}, {0, 0, 0})) along += std::abs(a.y - b.y) > 0.5 ? 1 : 0;
  CHECK(along == 2);
}

TEST_CASE("edges are lit where a projector of the test's own lights them, and only there") {
  own::Lens lens;
  lens.width = 400;
  lens.height = 300;
  lens.fx = lens.fy = 420.0;
  lens.cx = 190.0;
  lens.cy = 160.0;
  lens.k1 = -0.2;
  lens.p1 = 0.004;
  lens.world_from_own = own::turned(10.0, -5.0, 3.0);
  lens.at = {-0.3, 0.1, 0.1};
  Projector projector;
  projector.name = "one";
  ProjectorModel model{400, 300, {420, 420}, {190, 160}, {-0.2, 0.0, 0.004, 0.0}, {}};
  const glm::dquat yaw = glm::angleAxis(glm::radians(10.0), glm::dvec3(0, 1, 0));
  const glm::dquat pitch = glm::angleAxis(glm::radians(-5.0), glm::dvec3(1, 0, 0));
  const glm::dquat roll = glm::angleAxis(glm::radians(3.0), glm::dvec3(0, 0, 1));
  model.world_from_projector = {{-0.3, 0.1, 0.1}, yaw * pitch * roll};
  const auto edges = model_edges({surface_of(box())}, model.world_from_projector.position_m);
  const auto front = [](const glm::dvec3& p) { return p.z > -1.6; };
  const auto codes = verify_picture(model, edges, front);
  const auto code_at = [&](const glm::dvec2& pixel) {
    return codes[static_cast<std::size_t>(pixel.y) * 400 + static_cast<std::size_t>(pixel.x)];
  };
  int on = 0;
  for (int i = 0; i <= 40; ++i) {
    const double s = i / 40.0 - 0.5;
    for (const own::Vector& p : {own::Vector{s, 0.5, -1.5}, {s, -0.5, -1.5}, {0.5, s, -1.5}, {-0.5, s, -1.5}}) {
      const auto pixel = lens.pixel(p);
      if (!pixel || pixel->x < 0 || pixel->y < 0 || pixel->x >= 400 || pixel->y >= 300) continue;
      CHECK(code_at(*pixel) > 100);
      ++on;
    }
    const auto hidden = lens.pixel({s, 0.5, -2.5});
    if (hidden && hidden->x > 0 && hidden->y > 0 && hidden->x < 400 && hidden->y < 300 && std::abs(s) < 0.4) {
      CHECK(code_at(*hidden) == 0);
    }
  }
  CHECK(on > 80);
}

TEST_CASE("what lies behind the projector is not drawn") {
  const ProjectorModel model{64, 48, {60, 60}, {32, 24}, {}, {{0, 0, -5.0}, {1, 0, 0, 0}}};
  const auto codes =
      verify_picture(model, model_edges({surface_of(box())}, {0, 0, -5}), [](const auto&) { return true; });
  CHECK(std::count(codes.begin(), codes.end(), std::uint8_t{0}) == 64 * 48);
}

TEST_CASE("edits set what differs, and make the project's projector the measured one") {
  Project project;
  project.projectors.emplace_back().name = "left";
  project.projectors.emplace_back().name = "right";
  const Projector& right = project.projectors[1];
  CHECK(calibrated_edits(right, projector_model(right)).empty());
  ProjectorModel measured = projector_model(right);
  measured.focal_px = {1501.25, 1499.5};
  measured.centre_px.y = 390.0;
  measured.distortion = {0.1, -0.02, 0.001, 0.0};
  measured.world_from_projector = {{0.1, 0.2, 0.3}, glm::angleAxis(0.3, glm::normalize(glm::dvec3(1, 2, 3)))};
  const auto edits = calibrated_edits(right, measured);
  CHECK(edits.size() == 6);  // not the centre's column
  const auto applied = apply_all(project, edits);
  REQUIRE(applied);
  CHECK(applied->projectors[0] == project.projectors[0]);
  const ProjectorModel now = projector_model(applied->projectors[1]);
  CHECK(now.focal_px == measured.focal_px);
  CHECK(now.distortion == measured.distortion);
  CHECK(glm::length(now.world_from_projector.rotation - measured.world_from_projector.rotation) < 1e-12);
}
