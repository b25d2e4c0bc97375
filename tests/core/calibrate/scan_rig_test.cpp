#include "core/calibrate/scan_rig.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "tests/core/calibrate/own_optics.h"

using namespace focalstage;

namespace {

constexpr double square_m = 0.06;

own::Lens projector() {
  own::Lens lens{800, 600, 1010.0, 1006.0, 409.0, 420.0};
  lens.k1 = -0.06;
  lens.k2 = 0.02;
  lens.world_from_own = own::turned(-13.0, -6.0, 1.5);
  lens.at = {-0.35, 0.22, 0.25};
  return lens;
}

own::Lens camera() {
  own::Lens lens{1280, 960, 1380.0, 1376.0, 632.0, 486.0};
  lens.k1 = -0.16;
  lens.k2 = 0.08;
  lens.world_from_own = own::turned(14.0, -3.0, -2.0);
  lens.at = {0.33, 0.05, 0.2};
  return lens;
}

ProjectorModel known() { return {800, 600, {1400.0, 1400.0}, {400.0, 300.0}, {}, {}}; }

struct Held {
  own::Vector corner;
  own::Matrix turn;

  own::Vector world(double x, double y) const { return own::plus(corner, own::times(turn, own::Vector{x, y, 0.0})); }
};

std::vector<Held> held(std::size_t count, double lean_deg) {
  std::vector<Held> all;
  const std::vector<double> depths{-1.0, -0.82, -1.08, -0.9, -1.04, -0.8, -1.12, -0.95};
  for (std::size_t i = 0; i < count; ++i) {
    const auto k = static_cast<double>(i);
    const own::Matrix turn = own::turned(lean_deg * std::cos(2.4 * k), lean_deg * std::sin(2.4 * k), 9.0 * k);
    const own::Vector middle{0.07 * std::cos(1.7 * k), 0.07 * std::sin(1.7 * k) - 0.02, depths[i % depths.size()]};
    all.push_back({own::minus(middle, own::times(turn, own::Vector{0.27, 0.21, 0.0})), turn});
  }
  return all;
}

bool inside(const own::Lens& lens, const glm::dvec2& pixel) {
  return pixel.x > 1 && pixel.y > 1 && pixel.x < lens.width - 1 && pixel.y < lens.height - 1;
}

/// What both see of boards of 9 x 7 squares, with errors of so many pixels along each axis.
std::vector<BoardView> views(const std::vector<Held>& boards, const own::Lens& seen_by, double corner_px,
                             double face_px, std::uint32_t seed = 1) {
  std::mt19937 dice(seed);
  std::normal_distribution<double> error(0.0, 1.0);
  std::vector<BoardView> all;
  for (const Held& board : boards) {
    BoardView& view = all.emplace_back();
    view.name = "board-" + std::to_string(all.size());
    for (int i = 0; i < 48; ++i) {
      const double x = (i % 8 + 1) * square_m;
      const double y = (6 - i / 8) * square_m;
      const auto seen = seen_by.pixel(board.world(x, y));
      const auto lit = projector().pixel(board.world(x, y));
      if (!inside(seen_by, *seen) || !inside(projector(), *lit)) continue;
      const glm::dvec2 by(corner_px * error(dice), corner_px * error(dice));
      view.corners.push_back({i, {x, y, 0.0}, *seen + by, *lit + glm::dvec2(0.5 * by.x, 0.5 * by.y)});
    }
    // The rays through the middles of pixels, met with the board's plane.
    const own::Vector normal = own::times(board.turn, own::Vector{0, 0, 1});
    for (int i = 0; i < 150; ++i) {
      const auto about =
          seen_by.pixel(board.world((1.2 + 6.6 * (i % 20) / 19.0) * square_m, (1.2 + 4.6 * (i / 20) / 7.0) * square_m));
      const glm::dvec2 pixel(std::floor(about->x) + 0.5, std::floor(about->y) + 0.5);
      const own::Vector along = seen_by.look(pixel.x, pixel.y);
      const double way = own::dot(own::minus(board.corner, seen_by.at), normal) / own::dot(along, normal);
      const auto lit = projector().pixel(own::plus(seen_by.at, own::scaled(along, way)));
      if (!inside(seen_by, pixel) || !inside(projector(), *lit)) continue;
      view.face.push_back({pixel, *lit + glm::dvec2(face_px * error(dice), face_px * error(dice))});
    }
  }
  return all;
}

struct Off {
  double mm = 0.0;
  double deg = 0.0;
};

/// Against the truth, in the first board's frame.
Off off_by(const ProjectorModel& found, const own::Lens& truth, const Held& frame) {
  const own::Vector at = own::times(own::transposed(frame.turn), own::minus(truth.at, frame.corner));
  const glm::dvec3& p = found.world_from_projector.position_m;
  const own::Matrix turn = own::times(own::transposed(frame.turn), truth.world_from_own);
  return {1e3 * own::length(own::minus({p.x, p.y, p.z}, at)),
          own::angle_deg(own::matrix_of(found.world_from_projector.rotation), turn)};
}

Fault fault_of(const std::vector<BoardView>& seen) {
  const auto rig = solve_scan_rig(known(), 1280, 960, seen);
  return rig ? Fault{} : rig.fault();
}

}  // namespace

TEST_CASE("exact corners give both lenses and poses exactly, a shifted projector lens too") {
  const auto boards = held(5, 30.0);
  const auto rig = solve_scan_rig(known(), 1280, 960, views(boards, camera(), 0.0, 0.0));
  REQUIRE(rig);
  CHECK(off_by(rig->projector, projector(), boards[0]).mm < 1e-3);
  CHECK(off_by(rig->projector, projector(), boards[0]).deg < 1e-4);
  CHECK(off_by(rig->camera, camera(), boards[0]).mm < 1e-3);
  CHECK(rig->projector.focal_px.x == doctest::Approx(1010.0).epsilon(1e-6));
  CHECK(rig->projector.centre_px.y == doctest::Approx(420.0).epsilon(1e-6));
  CHECK(rig->projector.distortion[0] == doctest::Approx(-0.06).epsilon(1e-4));
  CHECK(rig->camera.distortion[1] == doctest::Approx(0.08).epsilon(1e-3));
  CHECK(rig->report.worst_px < 1e-4);
}

TEST_CASE("errors are as large as is said of them") {
  double off_mm2 = 0.0;
  double said_mm2 = 0.0;
  double off_deg2 = 0.0;
  double said_deg2 = 0.0;
  const auto boards = held(5, 35.0);
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    const auto rig = solve_scan_rig(known(), 1280, 960, views(boards, camera(), 0.06, 0.03, seed));
    REQUIRE(rig);
    const Off off = off_by(rig->projector, projector(), boards[0]);
    off_mm2 += off.mm * off.mm;
    off_deg2 += off.deg * off.deg;
    said_mm2 += std::pow(rig->report.uncertainty.position_mm, 2);
    said_deg2 += std::pow(rig->report.uncertainty.rotation_deg, 2);
  }
  CHECK(std::sqrt(off_mm2 / said_mm2) > 0.4);
  CHECK(std::sqrt(off_mm2 / said_mm2) < 1.8);
  CHECK(std::sqrt(off_deg2 / said_deg2) > 0.4);
  CHECK(std::sqrt(off_deg2 / said_deg2) < 1.8);
}

TEST_CASE("corners that stray are dropped, a capture after a bump is named") {
  const auto boards = held(5, 30.0);
  auto seen = views(boards, camera(), 0.05, 0.03);
  seen[2].corners[7].camera_px += glm::dvec2(6.0, -4.0);
  seen[2].face[11].projector_px += glm::dvec2(-9.0, 3.0);
  const auto rig = solve_scan_rig(known(), 1280, 960, seen);
  REQUIRE(rig);
  CHECK(rig->report.worst_px < 1.0);
  own::Lens bumped = camera();
  bumped.at[1] += 0.003;
  // The first is the frame of all others.
  seen = views(boards, camera(), 0.05, 0.03);
  seen[0] = views(boards, bumped, 0.05, 0.03)[0];
  const Fault fault = fault_of(seen);
  CHECK(fault.code == "scan.view-off");
  CHECK(fault.where == "board-1");
}

TEST_CASE("too few, all alike, another board than told: refused") {
  CHECK(fault_of(views(held(3, 30.0), camera(), 0.05, 0.03)).code == "scan.few");
  CHECK(fault_of(views(held(5, 0.3), camera(), 0.05, 0.03)).code == "scan.alike");
  auto seen = views(held(5, 30.0), camera(), 0.05, 0.03);
  for (BoardView& view : seen) {
    for (SeenCorner& corner : view.corners) corner.board_m.x *= 1.5;  // no squares
  }
  CHECK_FALSE(fault_of(seen).code.empty());
}
