#include "core/percept/contrast.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/optics/image_plan.h"
#include "core/percept/seen_frame.h"
#include "tests/support/shapes.h"

using namespace focalstage;

namespace {

constexpr double away_m = 0.8;

/// A wall square to a projector, larger than its picture.
struct Room {
  Project project;
  Stage stage;

  Room() {
    project.projectors.resize(1);
    project.projectors[0].pose = {{0.0, 0.0, 0.0}, {1, 0, 0, 0}};
    project.slices.powers_d = {-0.5, 0.0, 0.5};
    project.surfaces.emplace_back();
    const Rigid wall{{0.0, 0.0, -away_m}, {1, 0, 0, 0}};
    stage.surfaces = {support::surface_of(support::standing(support::rectangle({3.0, 3.0}), wall))};
  }
  Projector& projector() { return project.projectors[0]; }

  SurfaceContrast contrast() const {
    const auto lit = lit_surfaces(stage, projector_model(project.projectors[0]));
    const auto all = contrasts_of(project, make_schedule(project, image_plan(project)).schedule, lit);
    REQUIRE(all.size() == 1);
    return all[0];
  }
};

}  // namespace

TEST_CASE("on a wall square to the axis pixels lie as densely everywhere as the lens says") {
  Room room;
  room.stage.surfaces[0].drawables[0].finish.a = {0.5, 0.25, 1.0};
  const auto lit = lit_surfaces(room.stage, projector_model(room.projector()));
  REQUIRE(lit.size() == 1);
  CHECK(lit[0].share == doctest::Approx(1.0));
  CHECK(lit[0].pixels_per_m2 == doctest::Approx(1400.0 * 1400.0 / (away_m * away_m)).epsilon(1e-6));
  CHECK(lit[0].albedo == doctest::Approx(0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722).epsilon(1e-6));
}

TEST_CASE("the part of the picture that meets a surface") {
  Room room;
  // Half as wide as the picture, as high: 1024 x 768 pixels are 0.5851 x 0.4389 m there.
  const Rigid wall{{0.0, 0.0, -away_m}, {1, 0, 0, 0}};
  room.stage.surfaces = {
      support::surface_of(support::standing(support::rectangle({0.5 * 1024 / 1400.0 * away_m, 2.0}), wall))};
  const auto lit = lit_surfaces(room.stage, projector_model(room.projector()));
  REQUIRE(lit.size() == 1);
  CHECK(lit[0].share == doctest::Approx(0.5).epsilon(0.03));
}

TEST_CASE("without leak and room, white has no bound over black") {
  const SurfaceContrast contrast = Room().contrast();
  CHECK(contrast.exposures == 3);
  CHECK(contrast.black() == 0.0);
  CHECK(std::isinf(contrast.ratio()));
}

TEST_CASE("three exposures leak three times") {
  Room room;
  room.projector().black_level = 0.004;
  const SurfaceContrast contrast = room.contrast();
  CHECK(contrast.leak == doctest::Approx(0.012));
  CHECK(contrast.ratio() == doctest::Approx((0.996 + 0.012) / 0.012));
}

TEST_CASE("the room's light counts for as long as the shutter is open, the projector's for its exposure") {
  Room room;
  room.project.ambient_lux = 3.0;
  CHECK_FALSE(room.contrast().knows_ambient);  // against a projector of unknown brightness
  room.projector().lumens = 100.0;
  room.project.glasses.shutter_open_ms = room.project.glasses.shutter_close_ms = 0.0;
  // Shutters that take no time: each eye's is open for half of the period, 25/3 ms, an exposure lasts 0.5 ms.
  const double white_lux = 100.0 / (1024 * 768) * 1400.0 * 1400.0 / (away_m * away_m);
  const double wanted = 3.0 / white_lux * (1000.0 / 120.0) / 0.5;
  const SurfaceContrast contrast = room.contrast();
  CHECK(contrast.knows_ambient);
  CHECK(contrast.ambient == doctest::Approx(wanted).epsilon(0.01));
  CHECK(contrast.ratio() == doctest::Approx((1.0 + wanted) / wanted).epsilon(0.01));
  CHECK(contrast.white_cd_m2 == doctest::Approx((1.0 + wanted) * white_lux * 0.03 / M_PI).epsilon(0.01));
}

TEST_CASE("an eye's input carries curve, leak, reference and the room's light") {
  Room room;
  room.project.ambient_lux = 3.0;
  room.projector().lumens = 100.0;
  room.projector().black_level = 0.01;
  room.projector().transfer = {0.0, 0.3, 1.0};
  const CompileSettings settings = compile_settings(room.project);
  FrameImages images{settings.images.size(), 1024, 768, 1, {}};
  images.codes.resize(images.count * images.bytes_per_image());
  const Schedule schedule = make_schedule(room.project, settings.images).schedule;
  const auto input = [&](const CompileSettings& with) {
    return seen_frame(room.stage, with, images, schedule, worn_glasses(room.project.glasses), Side::left,
                      room_light_of(room.project));
  };
  const RetinaInput plain = input(settings);
  CHECK(plain.black_level == 0.01);
  CHECK(plain.transfer == room.projector().transfer);
  CHECK_FALSE(plain.falloff_reference_m.has_value());
  double ambient = 0.0;
  for (const PowerShare& part : plain.ambient) ambient += part.share;
  CHECK(ambient == doctest::Approx(room.contrast().ambient).epsilon(1e-3));
  CompileSettings even = settings;
  even.slices.compensation.mode = CompensationMode::even;
  even.reference_m = 2.0 * away_m;  // where white is a quarter as bright
  const RetinaInput thinning = input(even);
  CHECK(thinning.falloff_reference_m == 2.0 * away_m);
  double more = 0.0;
  for (const PowerShare& part : thinning.ambient) more += part.share;
  CHECK(more == doctest::Approx(4.0 * ambient).epsilon(1e-3));
}
