#include "editor/pipeline/focal_sweep.h"

#include <doctest/doctest.h>

#include <memory>
#include <vector>

#include "core/stage/stage.h"

using namespace focalstage;

namespace {

constexpr int side_px = 160;

/// A board square to the gaze, 0.5 m from the lens, lit by a grating and seen through one power.
struct Grating {
  Stage stage;
  std::vector<std::uint8_t> codes = std::vector<std::uint8_t>(side_px * side_px);
  RetinaInput input;

  explicit Grating(double power_d) {
    StagedSurface board;
    board.name = "board";
    auto mesh = std::make_shared<Mesh>();
    mesh->positions_m = {{-0.5, -0.5, -0.515}, {0.5, -0.5, -0.515}, {0.5, 0.5, -0.515}, {-0.5, 0.5, -0.515}};
    mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
    Drawable drawable;
    drawable.mesh = mesh;
    board.drawables.push_back(drawable);
    stage.surfaces.push_back(board);
    for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = (i % side_px) / 8 % 2 == 0 ? 255 : 0;
    input.stage = &stage;
    input.projector.width_px = input.projector.height_px = side_px;
    input.projector.focal_px = {300.0, 300.0};
    input.projector.centre_px = {side_px / 2.0, side_px / 2.0};
    input.exposures.push_back({codes, {{power_d, 1.0}}, true});
  }
};

RetinaView small_view() {
  RetinaView view;
  view.width_px = view.height_px = 200;
  view.fov_deg = 20.0;
  return view;
}

}  // namespace

TEST_CASE("a board seen through a power is sharpest at 1/d - v") {
  for (const double power_d : {0.0, 0.8}) {
    CAPTURE(power_d);
    const Grating grating(power_d);
    Retinas retina;
    std::vector<int> taken;
    const auto take = [&](int i, const RetinaImage& picture) {
      CHECK(picture.width_px == 200);
      taken.push_back(i);
      return Status();
    };
    const auto sweep = sweep_focus(retina, {&grating.input, 1}, small_view(), {}, {0.6, 2.6, 11}, take, {});
    REQUIRE(sweep);
    CHECK(taken == std::vector{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
    CHECK(sweep->focus_d.front() == 0.6);
    CHECK(sweep->focus_d.back() == 2.6);
    REQUIRE(sweep->things.size() == 1);
    REQUIRE(sweep->peaks.front());
    CHECK(sweep->peaks.front()->inside);
    CHECK(sweep->peaks.front()->focus_d == doctest::Approx(2.0 - power_d).epsilon(0.02));
  }
}

TEST_CASE("who takes the pictures can end the sweep, and so can a stop request") {
  const Grating grating(0.0);
  Retinas retina;
  int taken = 0;
  const auto full = [&](int i, const RetinaImage&) {
    ++taken;
    return i < 2 ? Status() : Status(Fault{"file.unwritable", "", "the disk is full", ""});
  };
  const auto sweep = sweep_focus(retina, {&grating.input, 1}, small_view(), {}, {1.0, 3.0, 9}, full, {});
  REQUIRE_FALSE(sweep);
  CHECK(sweep.fault().code == "file.unwritable");
  CHECK(taken == 3);

  std::stop_source stop;
  const auto stopped = sweep_focus(
      retina, {&grating.input, 1}, small_view(), {}, {1.0, 3.0, 9},
      [&](int, const RetinaImage&) {
        stop.request_stop();
        return Status();
      },
      stop.get_token());
  REQUIRE_FALSE(stopped);
  CHECK(stopped.fault().code == "retina.cancelled");
}
