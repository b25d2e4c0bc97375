#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/compile/compile.h"
#include "core/reference/reference.h"
#include "tests/exact/compare.h"
#include "tests/exact/random_colours.h"
#include "tests/support/shapes.h"

// Codes that make up for what surfaces, black and distance do to light (docs/colour.md). What comes back is reckoned
// here from the codes alone, by the projector's own curve and the paint that the test chose.

using namespace focalstage;
using namespace focalstage::exact;

namespace {

constexpr int width_px = 160, height_px = 120;
constexpr double screen_m = 0.515;  ///< from the pupils

/// A wall before the viewer, filled with one colour by a card far behind it and larger than can be seen.
struct Room {
  Stage stage;
  Project project;

  explicit Room(const glm::dvec3& wanted, double turn_rad = 0.0) {
    const Rigid wall{{0.0, 0.0, -screen_m}, glm::angleAxis(turn_rad, glm::normalize(glm::dvec3(0.4, 1.0, 0.0)))};
    stage.surfaces = {support::surface_of(support::standing(support::rectangle({1.6, 1.2}), wall))};
    Drawable card = support::standing(support::rectangle({9.0, 9.0}), Rigid{{0.0, 0.0, -0.7}, {1, 0, 0, 0}});
    card.finish.a = wanted;
    stage.objects = {support::object_of(card)};
    Projector projector;
    projector.width_px = width_px;
    projector.height_px = height_px;
    projector.fx_px = projector.fy_px = 200.0;
    projector.cx_px = width_px / 2.0;
    projector.cy_px = height_px / 2.0;
    projector.color = ColorMode::rgb;
    projector.pose = support::looking({0.25, 0.2, 0.1}, {0.0, 0.0, -screen_m});
    project.projectors = {projector};
    project.slices.powers_d = {-1.0, -0.5, 0.0, 0.5, 1.0};
    project.surfaces.emplace_back();
  }

  Projector& projector() { return project.projectors[0]; }
  Compensation& asked() { return project.slices.compensation; }
  void paint(const glm::dvec3& albedo) { stage.surfaces[0].drawables[0].finish.a = albedo; }

  CompiledFrame compiled(ClipMap* clips = nullptr) const {
    auto frame = Compiler(compile_settings(project)).frame(stage, {}, {}, clips);
    REQUIRE(frame);
    return *std::move(frame);
  }
};

double code_at(const FrameImages& images, std::size_t image, int x, int y, int channel) {
  const auto at =
      (static_cast<std::size_t>(y) * static_cast<std::size_t>(images.width_px) + static_cast<std::size_t>(x)) *
      static_cast<std::size_t>(images.channels);
  return images.image(image)[at + static_cast<std::size_t>(channel)];
}

/// What an eye (0 left, 1 right) gets of a pixel's light over all its exposures, before the surface takes its part: the
/// looks of all slices lie on the card, whose slices have weights that sum to one.
double light_of(const Room& room, const CompiledFrame& frame, int eye, int x, int y, int channel) {
  const Projector& projector = room.project.projectors[0];
  double sum = 0.0;
  const std::size_t slices = room.project.slices.powers_d.size();
  for (std::size_t n = 0; n < slices; ++n) {
    const double share = std::pow(
        code_at(frame.images, static_cast<std::size_t>(eye) * slices + n, x, y, channel) / 255.0, projector.gamma);
    sum += projector.black_level + (1.0 - projector.black_level) * share;
  }
  return sum;
}

/// The worst miss of `wanted` among what comes back, in codes of a whole exposure, over all pixels and both eyes.
double worst_miss(const Room& room, const CompiledFrame& frame, const glm::dvec3& albedo, const glm::dvec3& wanted) {
  double worst = 0.0;
  for (int eye = 0; eye < 2; ++eye) {
    for (int y = 0; y < height_px; ++y) {
      for (int x = 0; x < width_px; ++x) {
        for (int c = 0; c < 3; ++c) {
          const double back = albedo[c] * light_of(room, frame, eye, x, y, c);
          worst = std::max(worst, 255.0 * std::abs(back - wanted[c]));
        }
      }
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("painted paper sends back what white paper would, within a code") {
  const glm::dvec3 wanted(0.3, 0.25, 0.2), albedo(0.8, 0.5, 0.3);
  Room room(wanted);
  room.paint(albedo);
  CHECK(worst_miss(room, room.compiled(), albedo, wanted) > 30.0);  // without a word the paint takes its part
  room.asked().mode = CompensationMode::albedo;
  const CompiledFrame frame = room.compiled();
  CHECK(worst_miss(room, frame, albedo, wanted) <= 1.0);
  REQUIRE(frame.measure.surfaces.size() == 1);
  CHECK(frame.measure.surfaces[0].too_bright == 0);
  CHECK(frame.measure.surfaces[0].too_dark == 0);
  CHECK(frame.measure.clipped_pixels == 0);
}

TEST_CASE("white asks for less, and leaves room for what returns little") {
  const glm::dvec3 wanted(1.0, 0.8, 0.6), albedo(0.6, 0.5, 0.4);
  Room room(wanted);
  room.paint(albedo);
  room.asked() = {CompensationMode::albedo, 0.6, {}, {}};
  CHECK(worst_miss(room, room.compiled(), albedo, 0.6 * wanted) <= 1.0);
}

TEST_CASE("what paint cannot send back is as bright as can be, counted by channel and marked") {
  const glm::dvec3 wanted(0.7, 0.7, 0.2), albedo(1.0, 0.5, 0.1);
  Room room(wanted);
  room.paint(albedo);
  room.project.slices.powers_d = {0.0};  // all of it in one slice
  room.asked().mode = CompensationMode::albedo;
  ClipMap clips;
  const CompiledFrame frame = room.compiled(&clips);
  const std::uint64_t pixels = 2 * width_px * height_px;  // an image for each eye
  REQUIRE(frame.measure.surfaces.size() == 1);
  const SurfaceAsked& asked = frame.measure.surfaces[0];
  CHECK(asked.lit_pixels == pixels);
  CHECK(asked.too_bright == pixels);
  CHECK(asked.bright_in == std::array<std::uint64_t, 3>{0, pixels, pixels});
  CHECK(asked.most == doctest::Approx(2.0).epsilon(1e-5));  // blue: 0.2 / 0.1
  CHECK(asked.too_dark == 0);
  CHECK(frame.measure.clipped_pixels == pixels);
  CHECK(code_at(frame.images, 0, 80, 60, 0) == std::floor(0.7 * 255.0 + 0.5));
  CHECK(code_at(frame.images, 0, 80, 60, 1) == 255.0);
  CHECK(code_at(frame.images, 0, 80, 60, 2) == 255.0);
  CHECK(clips.width_px == width_px);
  const auto [least, most] = std::minmax_element(clips.bright.begin(), clips.bright.end());
  CHECK(*least == doctest::Approx(1.0).epsilon(1e-4));
  CHECK(*most == doctest::Approx(1.0).epsilon(1e-4));
  CHECK(*std::max_element(clips.dark.begin(), clips.dark.end()) == 0.0f);
}

TEST_CASE("a gray projector makes up for the paint's luminance") {
  const glm::dvec3 albedo(0.9, 0.4, 0.2);
  const double returned = 0.2126 * albedo.r + 0.7152 * albedo.g + 0.0722 * albedo.b;
  Room room(glm::dvec3(0.4));
  room.paint(albedo);
  room.projector().color = ColorMode::gray;
  room.project.slices.powers_d = {0.0};
  room.asked().mode = CompensationMode::albedo;
  CHECK(code_at(room.compiled().images, 0, 80, 60, 0) == std::floor(255.0 * 0.4 / returned + 0.5));
}

TEST_CASE("black leaks in every exposure, and is taken off once altogether") {
  const glm::dvec3 wanted(0.5, 0.4, 0.3), albedo(0.9, 0.8, 0.7);
  Room room(wanted);
  room.paint(albedo);
  room.projector().black_level = 0.01;
  room.projector().gamma = 2.2;
  // Five exposures to each eye leak five hundredths; codes that know nothing of it are too bright by that.
  CHECK(worst_miss(room, room.compiled(), albedo, albedo * (0.05 + 0.99 * wanted)) <= 1.5);
  room.asked().mode = CompensationMode::albedo;
  const CompiledFrame frame = room.compiled();
  CHECK(worst_miss(room, frame, albedo, wanted) <= 1.5);  // two slices' codes round off
  CHECK(frame.measure.surfaces[0].too_dark == 0);
}

TEST_CASE("what is darker than the leak cannot be had: the leak is seen, and counted") {
  const glm::dvec3 wanted(0.5, 0.02, 0.5);  // five exposures leak 0.05
  Room room(wanted);
  room.projector().black_level = 0.01;
  room.asked().mode = CompensationMode::albedo;
  ClipMap clips;
  const CompiledFrame frame = room.compiled(&clips);
  const SurfaceAsked& asked = frame.measure.surfaces[0];
  CHECK(asked.dark_in[0] == 0);
  CHECK(asked.dark_in[1] == asked.too_dark);
  CHECK(asked.dark_in[2] == 0);
  CHECK(asked.too_dark >= 2u * width_px * height_px);  // at least one slice of each eye
  CHECK(light_of(room, frame, 0, 80, 60, 1) == doctest::Approx(0.05));
  CHECK(*std::max_element(clips.dark.begin(), clips.dark.end()) > 0.005f);
}

TEST_CASE("even light: as many pixels' worth of it on every patch of a wall that leans away") {
  Room room(glm::dvec3(0.8), 0.5);
  room.project.slices.powers_d = {0.0};
  room.projector().distortion = {-0.1, 0.02, 0.003, -0.002, 0.01};
  const auto patches = [&](const CompiledFrame& frame) {
    // A patch of 5 mm on the wall: its light is that of the pixel at its middle, times the pixels that it takes up in
    // the projector's image, which are counted by the image of its corners.
    const ProjectorModel model = projector_model(room.projector());
    const Rigid projector_from_world = model.world_from_projector.inverse();
    const glm::dmat4 wall = room.stage.surfaces[0].drawables[0].world_from_mesh;
    const auto place = [&](double x, double y) {
      const glm::dvec3 seen = projector_from_world.point(glm::dvec3(wall * glm::dvec4(x, y, 0.0, 1.0)));
      return place_of_tangent(model, glm::dvec2(seen) / -seen.z);
    };
    std::vector<double> light;
    for (double y = -0.3; y <= 0.3; y += 0.02) {
      for (double x = -0.4; x <= 0.4; x += 0.02) {
        const glm::dvec2 middle = place(x, y);
        if (middle.x < 2.0 || middle.y < 2.0 || middle.x > width_px - 2.0 || middle.y > height_px - 2.0) continue;
        const glm::dvec2 across = place(x + 0.0025, y) - place(x - 0.0025, y);
        const glm::dvec2 up = place(x, y + 0.0025) - place(x, y - 0.0025);
        const double pixels = std::abs(across.x * up.y - across.y * up.x);
        light.push_back(pixels * code_at(frame.images, 0, static_cast<int>(middle.x), static_cast<int>(middle.y), 0));
      }
    }
    REQUIRE(light.size() > 200);
    const auto [least, most] = std::minmax_element(light.begin(), light.end());
    return *most / *least;
  };
  CHECK(patches(room.compiled()) > 1.5);
  room.asked() = {CompensationMode::even, 0.5, 0.75, {}};
  const CompiledFrame even = room.compiled();
  CHECK(even.measure.clipped_pixels == 0);
  // A pixel is a few millimetres of wall: what changes within it, and half a code, is left.
  CHECK(patches(even) < 1.02);
}

TEST_CASE("at the reference, square to the axis, even changes nothing") {
  Room room(glm::dvec3(0.6));
  room.projector().pose = {{0.0, 0.0, 0.2}, {1, 0, 0, 0}};
  room.project.slices.powers_d = {0.0};
  const CompiledFrame plain = room.compiled();
  room.asked() = {CompensationMode::even, 1.0, screen_m + 0.2, {}};
  CHECK(difference(room.compiled().images.codes, plain.images.codes).worst == 0);
  room.asked().reference_m.reset();
  room.projector().focus_m = screen_m + 0.2;  // without a word the focus is the reference
  CHECK(difference(room.compiled().images.codes, plain.images.codes).worst == 0);
}

TEST_CASE("surface light keeps the surface's colour: it is evened, and not made white") {
  Room room(glm::dvec3(0.0));
  room.stage.objects.clear();
  room.stage.surfaces[0].illumination = room.project.surfaces[0].illumination = 0.5;
  room.paint({0.8, 0.2, 0.1});
  room.projector().black_level = 0.01;
  room.asked() = {CompensationMode::albedo, 0.8, {}, {}};
  const CompiledFrame frame = room.compiled();
  const std::size_t zero = 2;  // the slice of no power carries it
  for (int c = 0; c < 3; ++c) CHECK(code_at(frame.images, zero, 80, 60, c) == std::floor(0.4 * 255.0 + 0.5));
}

TEST_CASE("a measured curve: the codes nearest to what it says") {
  Room room(glm::dvec3(0.5));
  room.project.slices.powers_d = {0.0};
  room.projector().transfer = {0.0, 0.1, 0.6, 1.0};               // at codes 0, 85, 170, 255
  CHECK(code_at(room.compiled().images, 0, 80, 60, 0) == 153.0);  // 85 + 85 * 0.4 / 0.5
}

TEST_CASE("compensation on white paper of a projector without black is no compensation") {
  for (std::uint64_t seed = 300; seed < 310; ++seed) {
    RandomScene scene = random_scene(seed);
    INFO(scene.story);
    const auto plain = Compiler(scene.settings).frame(scene.frames[0]);
    scene.settings.slices.compensation.mode = CompensationMode::albedo;
    const auto same = Compiler(scene.settings).frame(scene.frames[0]);
    REQUIRE(plain);
    REQUIRE(same);
    CHECK(difference(plain->images.codes, same->images.codes).worst <= 1);
  }
}

TEST_CASE("random rooms with paint, leaks and measured curves: the engine shows what the reference shows") {
  const char* given = std::getenv("FOCALSTAGE_SEED");
  const std::uint64_t first = given ? std::stoull(given) : std::random_device{}();
  MESSAGE("FOCALSTAGE_SEED=" << first);
  Difference all;
  int asked_too_much = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    RandomScene scene = coloured(random_scene(first + i));
    if (i % 4 == 3) scene.settings.projector.layout = PixelLayout::diamond;
    INFO(scene.story);
    Compiler compiler(scene.settings);
    for (const Stage& stage : scene.frames) {
      const auto fast = compiler.frame(stage);
      const auto reference = compile_reference(stage, scene.settings);
      REQUIRE(fast);
      REQUIRE(reference);
      const Difference here = difference(fast->images.codes, reference->images.codes);
      CHECK(here.off <= 3 + here.bytes / 100'000);
      all += here;
      REQUIRE(fast->measure.surfaces.size() == reference->measure.surfaces.size());
      for (std::size_t s = 0; s < stage.surfaces.size(); ++s) {
        const SurfaceAsked &a = fast->measure.surfaces[s], &b = reference->measure.surfaces[s];
        CHECK(a.index == b.index);
        const auto alike = [](std::uint64_t x, std::uint64_t y) { return (x > y ? x - y : y - x) <= 20 + y / 200; };
        CHECK(alike(a.lit_pixels, b.lit_pixels));
        CHECK(alike(a.too_bright, b.too_bright));
        CHECK(alike(a.too_dark, b.too_dark));
        asked_too_much += b.too_bright > 0 ? 1 : 0;
      }
    }
  }
  MESSAGE(all.off << " of " << all.bytes << " bytes are off by more than one code");
  CHECK(all.off * 1'000'000 <= all.bytes + 3'000'000);
  CHECK(asked_too_much > 10);
}

TEST_CASE("paint changes no byte between threads and instruction sets") {
  for (std::uint64_t seed = 800; seed < 815; ++seed) {
    const RandomScene scene = coloured(random_scene(seed));
    INFO(scene.story);
    const auto one = Compiler(scene.settings, 1, VectorPath::best).frame(scene.frames[0]);
    const auto two = Compiler(scene.settings, 2, VectorPath::portable).frame(scene.frames[0]);
    REQUIRE(one);
    REQUIRE(two);
    CHECK(one->images.codes == two->images.codes);
    CHECK(one->measure.surfaces == two->measure.surfaces);
  }
}
