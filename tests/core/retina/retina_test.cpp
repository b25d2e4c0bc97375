#include "core/retina/retina.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include <glm/gtc/quaternion.hpp>

#include "tests/core/retina/rig.h"

using namespace focalstage;
using namespace focalstage::retina_test;

namespace {

std::vector<std::uint8_t> full(const ProjectorModel& projector, int channels = 1) {
  return std::vector<std::uint8_t>(static_cast<std::size_t>(projector.width_px * projector.height_px * channels), 255);
}

CompileSettings settings_of(const ProjectorModel& projector, std::vector<double> powers_d, Breathing breathing) {
  Project project;
  project.slices.powers_d = std::move(powers_d);
  project.slices.breathing = breathing;
  CompileSettings settings;
  settings.projector = projector;
  settings.slices = project.slices;
  settings.images = image_plan(project);
  return settings;
}

/// A slanted white plane that runs through all focal planes of five slices.
struct Slanted {
  Stage stage = screen_stage();
  CompileSettings settings;
  CompiledFrame frame;

  explicit Slanted(Breathing breathing, glm::ivec2 squares = {1, 1})
      : settings(settings_of(projector_at({0.1, 0.2, 0.0}, 900.0, 1024, 768), {-1.0, -0.5, 0.0, 0.5, 1.0}, breathing)) {
    const Rigid standing{{0.0, 0.0, -0.6}, glm::angleAxis(1.0, glm::dvec3(0.0, 1.0, 0.0))};
    Drawable plane = support::standing(support::rectangle({3.0, 3.0}), standing);
    plane.finish.kind = Finish::Kind::checker;
    plane.finish.squares = squares;
    stage.objects = {support::object_of(plane)};
    frame = *Compiler(settings).frame(stage);
  }
};

/// Means of ten columns over the middle rows.
std::vector<double> profile(const RetinaImage& image, int from, int to) {
  std::vector<double> means;
  for (int x = from; x + 10 <= to; x += 2) {
    double sum = 0.0;
    for (int y = image.height_px / 4; y < image.height_px * 3 / 4; ++y) {
      for (int i = 0; i < 10; ++i) sum += at(image, x + i, y);
    }
    means.push_back(sum / (10.0 * (image.height_px / 2)));
  }
  return means;
}

double largest_step(const std::vector<double>& means) {
  double most = 0.0;
  for (std::size_t i = 5; i < means.size(); ++i) most = std::max(most, std::abs(means[i] - means[i - 5]));
  return most;
}

}  // namespace

TEST_CASE("the slices of a slanted white plane add up without a seam") {
  const Slanted exact(Breathing::exact);
  RetinaView view;
  view.fov_deg = 30.0;
  view.focus_d = 2.0;
  for (const Side side : both_sides) {
    view.eye = side;
    const auto image = Retina().view(input_of(exact.stage, exact.settings, exact.frame, side), view);
    REQUIRE(image);
    const std::vector<double> means = profile(*image, 0, view.width_px);
    for (const double mean : means) CHECK(mean == doctest::Approx(1.0).epsilon(0.02));
    CHECK(largest_step(means) < 0.01);
  }
}

TEST_CASE("a slanted checker in focus has the contrast it was painted with") {
  const Slanted checker(Breathing::exact, {40, 40});
  RetinaView view;
  view.fov_deg = 20.0;
  view.width_px = 800;
  view.height_px = 600;
  view.pupil_m = 0.0;
  const auto image = Retina().view(input_of(checker.stage, checker.settings, checker.frame, Side::left), view);
  REQUIRE(image);
  int lit = 0, dark = 0, between = 0;
  for (std::size_t i = 0; i < image->rgb.size(); i += 3) {
    const float light = image->rgb[i];
    ++(light > 0.97f && light < 1.03f ? lit : light < 0.03f ? dark : between);
  }
  CHECK(lit > 160000);
  CHECK(dark > 160000);
  CHECK(between < 70000);  // the squares' edges
}

namespace {

/// A white plane in the two halves of the nearest rule, -1 D and +1 D, that meet at x = 0.15 on the screen, seen from
/// close by: the width, in looks, of what is missing of it (an overlap counts as less than nothing).
struct Seam {
  double missing = 0.0;
  double darkest = 1.0;

  explicit Seam(Breathing breathing) {
    Stage stage = screen_stage();
    CompileSettings settings = settings_of(projector_at({0.1, 0.2, 0.0}, 900.0, 1024, 768), {-1.0, 1.0}, breathing);
    settings.slices.assignment = Assignment::nearest;
    const Rigid standing{{0.15, 0.0, -0.515}, glm::angleAxis(0.9, glm::dvec3(0.0, 1.0, 0.0))};
    stage.objects = {support::object_of(support::standing(support::rectangle({9.0, 9.0}), standing))};
    const CompiledFrame frame = *Compiler(settings).frame(stage);
    RetinaView view;
    view.fov_deg = 4.0;
    view.gaze = {0.1815 / 0.515, 0.0};
    view.pupil_m = 0.0;
    const auto image = Retina().view(input_of(stage, settings, frame, Side::left), view);
    REQUIRE(image);
    const double per_px = 2.0 * std::tan(2.0 * M_PI / 180.0) / view.width_px;
    for (int y = 100; y < 200; ++y) {
      for (int x = 0; x < view.width_px; ++x) {
        missing += (1.0 - double{at(*image, x, y)}) * per_px / 100.0;
        darkest = std::min(darkest, double{at(*image, x, y)});
      }
    }
  }
};

}  // namespace

TEST_CASE("with the nearest rule no seam is wider than a pixel of the projector") {
  // The projector's pixels are 0.55 m / 900 on the screen, 1.2e-3 as looks.
  CHECK(std::abs(Seam(Breathing::exact).missing) < 1.2e-3);
}

TEST_CASE("with breathing off the slices part by as much as the lens says") {
  // The plane crosses v* = 0 at x = 0.15, which the left eye sees at (0.15 + 0.0315) / 0.515 = 0.3524. A power v shows
  // it at 0.3524 * 0.515 / (0.515 - 0.015 * 0.5 v): for -1 and +1 D 0.3474 and 0.3576, a gap of 0.01027.
  const double look = 0.1815 / 0.515;
  const double gap = look * 0.515 * (1.0 / (0.515 - 0.0075) - 1.0 / (0.515 + 0.0075));
  const Seam seam(Breathing::off);
  CHECK(std::abs(seam.missing) == doctest::Approx(gap).epsilon(0.05));
}

TEST_CASE("an object is seen in its straight direction, whichever slice shows it") {
  Stage stage = screen_stage();
  ProjectorModel projector = projector_at({0.2, 0.25, 0.05}, 1400.0, 1024, 768);
  projector.distortion = {-0.1, 0.02, 0.001, -0.001, 0.0};
  const CompileSettings settings = settings_of(projector, {-1.5, -0.5, 0.0, 1.0, 2.0}, Breathing::exact);
  const glm::dvec3 centre_m{-0.07, 0.05, -0.8};
  const Drawable square =
      support::standing(support::rectangle({0.09, 0.09}), {centre_m, glm::angleAxis(0.3, glm::dvec3(0.0, 0.0, 1.0))});
  Compiler compiler(settings);
  Retina retina;
  for (int slice = 0; slice < 5; ++slice) {
    Depth depth;
    depth.mode = DepthMode::slice;
    depth.index = slice;
    stage.objects = {support::object_of(square, depth)};
    const CompiledFrame frame = *compiler.frame(stage);
    for (const Side side : both_sides) {
      INFO("slice " << slice << " eye " << index_of(side));
      RetinaView view;
      view.eye = side;
      view.focus_d = 0.5;
      const auto image = retina.view(input_of(stage, settings, frame, side), view);
      REQUIRE(image);
      // Square to the gaze, so that its centre of light is its centre; the pupils lie at -+31.5 mm.
      const double aside_m = centre_m.x - (side == Side::left ? -0.0315 : 0.0315);
      const glm::dvec2 expected = pixel_of_look(view, {aside_m / 0.8, 0.05 / 0.8});
      const Moments seen = moments_of(*image);
      CHECK(std::abs(seen.centre.x - expected.x) < 0.1);
      CHECK(std::abs(seen.centre.y - expected.y) < 0.1);
    }
  }
}

TEST_CASE("the head moves, the pictures stay on the surface") {
  const Stage stage = screen_stage();
  const ProjectorModel projector = projector_at({0.0, 0.2, 0.0}, 900.0, 640, 480);
  std::vector<std::uint8_t> codes(640 * 480, 0);
  for (int y = 230; y < 250; ++y) {
    for (int x = 310; x < 330; ++x) codes[static_cast<std::size_t>(y * 640 + x)] = 255;
  }
  RetinaInput input = input_of(stage, projector);
  input.exposures = {shown(codes, 0.0)};
  Retina retina;
  const auto centre = [&](const glm::dvec3& offset_m, double power_d) {
    input.exposures[0].powers[0].power_d = power_d;
    RetinaView view;
    view.head_offset_m = offset_m;
    const auto image = retina.view(input, view);
    REQUIRE(image);
    return moments_of(*image).centre;
  };
  const double per_px = 2.0 * std::tan(25.0 * M_PI / 180.0) / 400.0;
  const glm::dvec2 before = centre({0.0, 0.0, 0.0}, 0.0);
  // 3 cm to the right: what lies 0.515 m away moves left by 0.03 / 0.515. 3 cm up: down, and rows run down.
  const glm::dvec2 right = centre({0.03, 0.0, 0.0}, 0.0);
  CHECK(right.x - before.x == doctest::Approx(-0.03 / screen_m / per_px).epsilon(0.005));
  CHECK(std::abs(right.y - before.y) < 0.05);
  const glm::dvec2 up = centre({0.0, 0.03, 0.0}, 0.0);
  CHECK(up.y - before.y == doctest::Approx(0.03 / screen_m / per_px).epsilon(0.005));
  // Through +2 D the same shift is stretched: 0.515 / (0.515 - 2 * 0.015 * 0.5) = 1.03.
  const glm::dvec2 there = centre({0.0, 0.0, 0.0}, 2.0);
  CHECK(centre({0.03, 0.0, 0.0}, 2.0).x - there.x == doctest::Approx(-1.03 * 0.03 / screen_m / per_px).epsilon(0.005));
  // 3 cm back: everything shrinks towards the gaze by 0.515 / 0.545.
  const glm::dvec2 back = centre({0.0, 0.0, 0.03}, 0.0);
  CHECK(back.x - 200.0 == doctest::Approx((before.x - 200.0) * 0.515 / 0.545).epsilon(0.005));
}

TEST_CASE("a surface hides what lies behind it and keeps the projector's light off it") {
  // A board 0.2 m wide 0.3 m before the left pupil, centred on its gaze, before a wall 0.6 m away. The projector stands
  // 0.1 m to the left at the eye's distance: the board's left edge shadows the wall at -0.1 + (-0.1 + 0.1) * 2 = -0.1
  // and its right edge at -0.1 + (0.1 + 0.1) * 2 = +0.3, seen at 0.3 / 0.6 = 0.5. The board covers looks up to 1/3.
  Stage stage;
  const Rigid eye_at{{-0.0315, 0.0, -0.3}, {1, 0, 0, 0}}, wall_at{{-0.0315, 0.0, -0.6}, {1, 0, 0, 0}};
  stage.surfaces = {support::surface_of(support::standing(support::rectangle({2.0, 2.0}), wall_at)),
                    support::surface_of(support::standing(support::rectangle({0.2, 0.2}), eye_at))};
  ProjectorModel projector = projector_at({}, 400.0, 1000, 800);
  projector.world_from_projector = Rigid{{-0.1315, 0.0, 0.0}, {1, 0, 0, 0}};
  const std::vector<std::uint8_t> codes = full(projector);
  RetinaInput input = input_of(stage, projector);
  input.lens_aperture_m = 0.1;
  input.exposures = {shown(codes, 0.0)};
  RetinaView view;
  view.fov_deg = 2.0 * std::atan(1.0) * 180.0 / M_PI;  // looks from -1 to 1, 0.005 a pixel
  view.pupil_m = 0.0;
  const auto image = Retina().view(input, view);
  REQUIRE(image);
  const auto lit = [&](double look_x) {
    return at(*image, static_cast<int>(pixel_of_look(view, {look_x, 0.0}).x), 150);
  };
  for (const double look : {-0.6, -0.35, -0.32, 0.0, 0.32, 0.51, 0.6}) CHECK(lit(look) == doctest::Approx(1.0));
  for (const double look : {0.345, 0.4, 0.49}) CHECK(lit(look) == 0.0f);
  // The shadow's edge, to a pixel of the retina.
  int edge = 0;
  for (int x = 270; x < 320; ++x) edge += at(*image, x, 150) == 0.0f ? 1 : 0;
  CHECK(std::abs(edge - (0.5 - 0.35) / 0.005) <= 1.0);
}

TEST_CASE("the lens is round and ends at its aperture") {
  const Stage stage = screen_stage();
  const ProjectorModel projector = projector_at({-0.0315, 0.0, 0.0}, 300.0, 800, 600);
  const std::vector<std::uint8_t> codes = full(projector);
  RetinaInput input = input_of(stage, projector);
  input.exposures = {shown(codes, 1.0)};
  RetinaView view;
  view.pupil_m = 0.0;
  view.fov_deg = 2.0 * std::atan(1.0) * 180.0 / M_PI;  // 0.005 a pixel
  const auto image = Retina().view(input, view);
  REQUIRE(image);
  double area = 0.0;
  for (std::size_t i = 0; i < image->rgb.size(); i += 3) area += image->rgb[i];
  CHECK(area * 0.005 * 0.005 == doctest::Approx(M_PI * std::pow(0.008 / 0.015, 2)).epsilon(0.003));  // +-28 degrees
}

TEST_CASE("codes are decoded as they were encoded, channel by channel") {
  const Stage stage = screen_stage();
  const ProjectorModel projector = projector_at({-0.0315, 0.0, 0.0}, 300.0, 400, 300);
  std::vector<std::uint8_t> codes = full(projector, 3);
  for (std::size_t i = 0; i < codes.size(); i += 3) {
    codes[i] = 9;
    codes[i + 1] = 6;
    codes[i + 2] = 0;
  }
  RetinaInput input = input_of(stage, projector);
  input.channels = 3;
  input.bits = 4;
  input.gamma = 2.0;
  input.exposures = {shown(codes, 0.0), shown(codes, 0.5)};
  const auto image = Retina().view(input, {});
  REQUIRE(image);
  CHECK(at(*image, 200, 150, 0) == doctest::Approx(2.0 * 0.36));  // (9 / 15)^2, twice
  CHECK(at(*image, 200, 150, 1) == doctest::Approx(2.0 * 0.16));
  CHECK(at(*image, 200, 150, 2) == 0.0f);
}

TEST_CASE("looking at a spot tells the focus that it asks for") {
  Stage stage = screen_stage();
  const CompileSettings settings =
      settings_of(projector_at({0.1, 0.2, 0.0}, 900.0, 1024, 768), {-1.0, -0.5, 0.0, 0.5, 1.0}, Breathing::exact);
  Depth depth;
  depth.mode = DepthMode::fixed;
  depth.vergence_d = 1.7;
  const Rigid there{{0.0, 0.0, -0.6}, {1, 0, 0, 0}};
  stage.objects = {support::object_of(support::standing(support::rectangle({0.15, 0.15}), there), depth)};
  const CompiledFrame frame = *Compiler(settings).frame(stage);
  const RetinaInput input = input_of(stage, settings, frame, Side::left);
  Retina retina;
  const auto seen = retina.look_at(input, {}, {0.0315 / 0.6, 0.0});
  REQUIRE(seen);
  REQUIRE(*seen);
  CHECK((*seen)->lit);
  CHECK((*seen)->vergence_d == doctest::Approx(1.7).epsilon(0.01));
  CHECK((*seen)->surface_m == doctest::Approx(0.5).epsilon(1e-5));
  CHECK((*seen)->world_m.z == doctest::Approx(-screen_m).epsilon(1e-5));
  CHECK(std::abs((*seen)->world_m.x + 0.0315 - screen_m * 0.0315 / 0.6) < 2e-3);  // the slice bends the look a little

  const auto dark = retina.look_at(input, {}, {-0.3, 0.2});
  REQUIRE(dark);
  REQUIRE(*dark);
  CHECK_FALSE((*dark)->lit);
  CHECK((*dark)->vergence_d == doctest::Approx(2.0));
  CHECK_FALSE(*retina.look_at(input, {}, {3.0, 0.0}));  // outside the picture
}

TEST_CASE("nothing to see is black") {
  const Stage empty;
  const ProjectorModel projector = projector_at({0.0, 0.1, 0.0}, 900.0, 64, 48);
  const std::vector<std::uint8_t> codes = full(projector);
  RetinaInput input = input_of(empty, projector);
  input.exposures = {shown(codes, 0.5)};
  Retina retina;
  for (int round = 0; round < 2; ++round) {
    const auto image = retina.view(input, {});
    REQUIRE(image);
    CHECK(image->rgb == std::vector<float>(400 * 300 * 3, 0.0f));
    CHECK_FALSE(*retina.look_at(input, {}, {0.0, 0.0}));
    input.exposures.clear();
  }
  const Stage screen = screen_stage();
  input.stage = &screen;
  CHECK(retina.view(input, {})->rgb == std::vector<float>(400 * 300 * 3, 0.0f));
  input.exposures = {shown(codes, 70.0)};  // its focus lies before the pupil: nothing comes through upright
  CHECK(retina.view(input, {})->rgb == std::vector<float>(400 * 300 * 3, 0.0f));
}

TEST_CASE("the picture does not depend on threads or on what was kept") {
  const Slanted scene(Breathing::exact, {30, 30});
  Stage moved = scene.stage;
  moved.surfaces[0].drawables[0].world_from_mesh[3].z -= 0.05;
  const RetinaInput input = input_of(scene.stage, scene.settings, scene.frame, Side::left);
  RetinaInput other = input;
  other.stage = &moved;
  RetinaView near;
  near.focus_d = 3.0;
  near.pupil_m = 0.008;
  Retina kept;
  const auto first = kept.view(input, {});
  const auto blurred = kept.view(input, near);
  const auto elsewhere = kept.view(other, {});
  const auto again = kept.view(input, {});
  REQUIRE(first);
  REQUIRE(again);
  CHECK(first->rgb == again->rgb);
  CHECK(first->rgb != blurred->rgb);
  CHECK(first->rgb != elsewhere->rgb);
  CHECK(blurred->rgb == Retina(1).view(input, near)->rgb);
  CHECK(elsewhere->rgb == Retina(1).view(other, {})->rgb);
}

TEST_CASE("a picture is the same after wide blurs as alone") {
  const Slanted scene(Breathing::exact, {30, 30});
  const RetinaInput input = input_of(scene.stage, scene.settings, scene.frame, Side::left);
  RetinaView view;
  view.pupil_m = 0.006;
  Retina kept;
  for (const double focus_d : {6.0, 0.0, 2.5, 9.0, 2.0, 2.1}) {
    view.focus_d = focus_d;
    INFO("focus " << focus_d);
    CHECK(kept.view(input, view)->rgb == Retina().view(input, view)->rgb);
  }
}

TEST_CASE("what means nothing is refused") {
  const Stage stage = screen_stage();
  const ProjectorModel projector = projector_at({0.0, 0.1, 0.0}, 900.0, 64, 48);
  const std::vector<std::uint8_t> codes = full(projector);
  RetinaInput good = input_of(stage, projector);
  good.exposures = {shown(codes, 0.5)};
  Retina retina;
  const auto refused = [&](auto&& spoil) {
    RetinaInput input = good;
    RetinaView view;
    spoil(input, view);
    const auto image = retina.view(input, view);
    return !image && image.fault().code == "retina.input" && !retina.look_at(input, view, {});
  };
  CHECK(retina.view(good, {}));
  CHECK(refused([](RetinaInput& input, RetinaView&) { input.stage = nullptr; }));
  CHECK(refused([](RetinaInput& input, RetinaView&) { input.channels = 3; }));
  CHECK(refused([](RetinaInput& input, RetinaView&) { input.bits = 0; }));
  CHECK(refused([](RetinaInput& input, RetinaView&) { input.gamma = NAN; }));
  CHECK(refused([](RetinaInput& input, RetinaView&) { input.exposures[0].powers[0].power_d = INFINITY; }));
  CHECK(refused([](RetinaInput& input, RetinaView&) { input.exposures[0].codes = {}; }));
  CHECK(refused([](RetinaInput&, RetinaView& view) { view.width_px = 0; }));
  CHECK(refused([](RetinaInput&, RetinaView& view) { view.width_px = view.height_px = 8000; }));
  CHECK(refused([](RetinaInput&, RetinaView& view) { view.fov_deg = 180.0; }));
  CHECK(refused([](RetinaInput&, RetinaView& view) { view.pupil_m = -0.001; }));
  CHECK(refused([](RetinaInput&, RetinaView& view) { view.focus_d = NAN; }));
  CHECK(refused([](RetinaInput&, RetinaView& view) { view.head_offset_m.y = NAN; }));
  CHECK(refused([](RetinaInput&, RetinaView& view) { view.gaze.x = INFINITY; }));
}

TEST_CASE("a stop request ends it soon, and the next call is whole") {
  const Slanted scene(Breathing::exact);
  const RetinaInput input = input_of(scene.stage, scene.settings, scene.frame, Side::left);
  Retina retina;
  std::stop_source before;
  before.request_stop();
  const auto never = retina.view(input, {}, before.get_token());
  REQUIRE_FALSE(never);
  CHECK(never.fault().code == "retina.cancelled");

  RetinaView large;
  large.width_px = large.height_px = 3000;
  std::stop_source stop;
  std::chrono::steady_clock::time_point asked;
  std::thread clock([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    asked = std::chrono::steady_clock::now();
    stop.request_stop();
  });
  const auto cut = retina.view(input, large, stop.get_token());
  const auto ended = std::chrono::steady_clock::now();
  clock.join();
  REQUIRE_FALSE(cut);
  CHECK(cut.fault().code == "retina.cancelled");
  CHECK(std::chrono::duration<double, std::milli>(ended - asked).count() < 200.0);
  CHECK(retina.view(input, {})->rgb == Retina().view(input, {})->rgb);
}
