#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "core/reference/seen.h"
#include "core/retina/retina.h"
#include "tests/core/retina/rig.h"

// What an eye sees of paint, leaking black, light that thins and the room's own: by hand where one number stands for
// all of the picture, else against rays.

using namespace focalstage;
using namespace focalstage::retina_test;

namespace {

constexpr int width_px = 120, height_px = 90;

/// A screen lit wholly by one exposure of one code.
struct Lit {
  Stage stage = screen_stage();
  ProjectorModel projector = projector_at({0.0, 0.0, 0.2}, 150.0, 200, 150);
  std::vector<std::uint8_t> codes;
  RetinaInput input;
  RetinaView view;

  explicit Lit(std::uint8_t code) : codes(static_cast<std::size_t>(projector.width_px * projector.height_px), code) {
    input = input_of(stage, projector);
    input.exposures = {shown(codes, 0.0)};
    view.width_px = width_px;
    view.height_px = height_px;
    view.fov_deg = 30.0;
  }
  Drawable& screen() { return stage.surfaces[0].drawables[0]; }

  RetinaImage seen() {
    auto image = Retina().view(input, view);
    REQUIRE(image);
    return *std::move(image);
  }
  glm::dvec3 middle() { return at(seen(), width_px / 2, height_px / 2); }

  static glm::dvec3 at(const RetinaImage& image, int x, int y) {
    const float* rgb = &image.rgb[3 * static_cast<std::size_t>(y * image.width_px + x)];
    return {rgb[0], rgb[1], rgb[2]};
  }
};

void check_colour(const glm::dvec3& seen, const glm::dvec3& wanted) {
  for (int c = 0; c < 3; ++c) CHECK(seen[c] == doctest::Approx(wanted[c]).epsilon(1e-4));
}

/// Root mean square of what parts two pictures, against the brightest value.
double miss(const RetinaImage& a, const RetinaImage& b) {
  double sum = 0.0, peak = 0.0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    const double off = static_cast<double>(a.rgb[i]) - b.rgb[i];
    sum += off * off;
    peak = std::max<double>(peak, b.rgb[i]);
  }
  return std::sqrt(sum / static_cast<double>(a.rgb.size())) / peak;
}

std::shared_ptr<const Texture> bands() {
  auto texture = std::make_shared<Texture>();
  texture->width_px = 12;
  texture->height_px = 2;
  for (int i = 0; i < 24; ++i) {
    const auto tone = static_cast<std::uint8_t>(90 + 12 * (i % 12));
    texture->rgba.insert(texture->rgba.end(), {tone, static_cast<std::uint8_t>(255 - tone / 2), 200, 255});
  }
  texture->wrap_u = texture->wrap_v = Wrap::clamp;
  return texture;
}

}  // namespace

TEST_CASE("paint tints what comes back, of gray light too") {
  Lit lit(255);
  lit.screen().finish.a = {0.8, 0.5, 0.25};
  check_colour(lit.middle(), {0.8, 0.5, 0.25});
}

TEST_CASE("each exposure leaks its black: seven of them seven times, whatever they show") {
  Lit lit(0);
  lit.input.black_level = 0.01;
  lit.input.exposures.assign(7, shown(lit.codes, 0.0));
  lit.screen().finish.a = {1.0, 0.5, 0.5};
  check_colour(lit.middle(), {0.07, 0.035, 0.035});
}

TEST_CASE("white is white with a leak as well: black and what is given make up one") {
  Lit lit(255);
  lit.input.black_level = 0.02;
  check_colour(lit.middle(), glm::dvec3(1.0));
}

TEST_CASE("codes by a measured curve") {
  Lit lit(51);  // a fifth of the way
  lit.input.transfer = {0.0, 0.5, 1.0};
  check_colour(lit.middle(), glm::dvec3(0.2));
  lit.input.transfer = {0.0, 0.01, 0.1, 0.3, 0.6, 1.0};
  check_colour(lit.middle(), glm::dvec3(0.01));
}

TEST_CASE("light thins with the square of the distance, 1 being the reference") {
  Lit lit(255);
  lit.input.falloff_reference_m = (screen_m + 0.2) / 2.0;  // the screen stands twice as far away
  check_colour(lit.middle(), glm::dvec3(0.25));
}

TEST_CASE("the room's light falls on what no projector reaches, as paint returns it") {
  Lit lit(0);
  lit.projector.width_px = 20;  // a small picture in the middle
  lit.projector.height_px = 20;
  lit.projector.centre_px = {10.0, 10.0};
  lit.codes.assign(400, 255);
  lit.input.projector = lit.projector;
  lit.input.exposures = {shown(lit.codes, 0.0)};
  lit.input.ambient = {{0.0, 0.02}, {0.5, 0.03}};
  lit.screen().finish.a = {0.9, 0.6, 0.3};
  const RetinaImage image = lit.seen();
  check_colour(Lit::at(image, 4, 4), 0.05 * glm::dvec3(0.9, 0.6, 0.3));
  check_colour(Lit::at(image, width_px / 2, height_px / 2), 1.05 * glm::dvec3(0.9, 0.6, 0.3));
}

TEST_CASE("a painted, leaning wall with a board before it, in a lit room: as rays see it") {
  Lit lit(0);
  lit.projector = projector_at({0.2, 0.15, 0.25}, 260.0, 220, 160);
  const Rigid leaning{{0.0, 0.0, -screen_m - 0.1}, glm::angleAxis(0.5, glm::dvec3(0.0, 1.0, 0.0))};
  lit.stage.surfaces = {
      support::surface_of(support::standing(support::rectangle({1.2, 0.9}), leaning)),
      support::surface_of(support::standing(support::rectangle({0.12, 0.1}), Rigid{{0.05, 0.0, -0.45}, {1, 0, 0, 0}}))};
  lit.stage.surfaces[0].drawables[0].finish.kind = Finish::Kind::textured;
  lit.stage.surfaces[0].drawables[0].finish.texture = bands();
  lit.stage.surfaces[1].drawables[0].finish.a = {0.3, 0.9, 0.4};
  const auto pixels = static_cast<std::size_t>(lit.projector.width_px * lit.projector.height_px);
  std::vector<std::uint8_t> first(pixels), second(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::size_t x = i % 220, y = i / 220;
    first[i] = (x / 20 + y / 20) % 2 == 0 ? 230 : 0;
    second[i] = y / 40 % 2 == 0 ? 0 : 120;
  }
  lit.input = input_of(lit.stage, lit.projector);
  lit.input.gamma = 1.8;
  lit.input.black_level = 0.06;
  lit.input.falloff_reference_m = 0.8;
  lit.input.exposures = {{first, {{-0.5, 0.5}, {-0.3, 0.5}}, true}, {second, {{0.4, 0.6}}, true}};
  lit.input.ambient = {{-0.6, 0.03}, {0.0, 0.04}, {0.6, 0.02}};
  lit.view.focus_d = 1.6;
  const RetinaImage fast = lit.seen();
  const auto rays = see_by_rays(lit.input, lit.view, {256});
  REQUIRE(rays);
  const double off = miss(fast, *rays);
  MESSAGE("root mean square miss " << 100.0 * off << " % of the brightest");
  CHECK(off < 0.02);
  // It would be noticed: the same without the paint, without the leak, without the falloff, without the room.
  RetinaInput other = lit.input;
  other.black_level = 0.0;
  CHECK(miss(*Retina().view(other, lit.view), *rays) > 0.02);
  other = lit.input;
  other.falloff_reference_m.reset();
  CHECK(miss(*Retina().view(other, lit.view), *rays) > 0.02);
  other = lit.input;
  other.ambient.clear();
  CHECK(miss(*Retina().view(other, lit.view), *rays) > 0.02);
  lit.stage.surfaces[1].drawables[0].finish.a = glm::dvec3(1.0);
  CHECK(miss(lit.seen(), *rays) > 0.02);
}

TEST_CASE("numbers that mean nothing are refused") {
  const auto refused = [](auto change) {
    Lit lit(255);
    change(lit.input);
    const auto image = Retina().view(lit.input, lit.view);
    return !image && image.fault().code == "retina.input";
  };
  CHECK(refused([](RetinaInput& input) { input.black_level = -0.1; }));
  CHECK(refused([](RetinaInput& input) { input.black_level = NAN; }));
  CHECK(refused([](RetinaInput& input) { input.transfer = {0.5}; }));
  CHECK(refused([](RetinaInput& input) { input.transfer = {0.0, NAN}; }));
  CHECK(refused([](RetinaInput& input) { input.falloff_reference_m = 0.0; }));
  CHECK(refused([](RetinaInput& input) { input.ambient = {{0.0, -1.0}}; }));
  CHECK(refused([](RetinaInput& input) { input.ambient = {{NAN, 1.0}}; }));
}
