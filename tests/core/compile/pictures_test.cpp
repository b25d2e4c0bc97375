#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "core/compile/compile.h"
#include "core/compile/shading.h"
#include "core/reference/reference.h"
#include "core/stage/texture_sample.h"
#include "tests/core/compile/cards.h"

using namespace focalstage;

namespace {

/// A row of 16-bit gray from 0 on, a step apart each.
std::shared_ptr<Texture> ramp(int width_px, int step, ColorSpace space) {
  auto texture = std::make_shared<Texture>();
  texture->width_px = width_px;
  texture->height_px = 1;
  texture->wrap_u = texture->wrap_v = Wrap::clamp;
  texture->magnify = Magnify::nearest;
  texture->color_space = space;
  for (int x = 0; x < width_px; ++x) {
    for (int c = 0; c < 4; ++c) texture->rgba16.push_back(static_cast<std::uint16_t>(c < 3 ? step * x : 65535));
  }
  return texture;
}

/// White, clear left of `split` (0..1) of its width.
std::shared_ptr<Texture> half_clear(int width_px, double split) {
  auto texture = std::make_shared<Texture>();
  texture->width_px = width_px;
  texture->height_px = 1;
  texture->magnify = Magnify::nearest;
  for (int x = 0; x < width_px; ++x) {
    for (int c = 0; c < 4; ++c) {
      texture->rgba.push_back(static_cast<std::uint8_t>(c == 3 && x < split * width_px ? 0 : 255));
    }
  }
  return texture;
}

void hang(Drawable& drawable, std::shared_ptr<const Texture> texture, double alpha_cutoff = 0.0) {
  drawable.finish = {};
  drawable.finish.kind = Finish::Kind::textured;
  drawable.finish.texture = std::move(texture);
  drawable.finish.alpha_cutoff = alpha_cutoff;
}

FrameImages compiled(const Stage& stage, const CompileSettings& settings) {
  auto frame = Compiler(settings).frame(stage);
  if (!frame) FAIL(describe(frame.fault()));
  return std::move(frame->images);
}

std::size_t off(const FrameImages& a, const FrameImages& b) {
  REQUIRE(a.codes.size() == b.codes.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.codes.size(); ++i) count += std::abs(int{a.codes[i]} - int{b.codes[i]}) > 1 ? 1 : 0;
  return count;
}

/// Pixels of a row whose codes differ from their left neighbours'.
std::size_t levels(const FrameImages& images) { return std::set<int>(images.codes.begin(), images.codes.end()).size(); }

/// A wall that fills the view with a card before it, 60 mm wide; `from` is where along its width the card begins.
Stage card_before_wall(double from) {
  Stage stage = cards::room(false);
  StagedObject near;
  near.index = 1;
  const double width_m = 0.06 * (1.0 - from);
  near.drawables.push_back(
      support::standing(support::rectangle({width_m, 0.06}), {{0.03 - width_m / 2.0, 0.0, -0.375}}));
  hang(near.drawables[0], half_clear(2, 0.0));
  stage.objects.push_back(near);
  return stage;
}

}  // namespace

TEST_CASE("a texture of 16 bits has more levels than 8 can hold, by the formula of its colour space") {
  for (const ColorSpace space : {ColorSpace::srgb, ColorSpace::linear}) {
    const auto texture = ramp(4096, 16, space);
    std::set<double> light;
    for (int x = 0; x < 4096; ++x) {
      const double share = 16.0 * x / 65535.0;
      const double expected = space == ColorSpace::linear ? share
                              : share <= 0.04045          ? share / 12.92
                                                          : std::pow((share + 0.055) / 1.055, 2.4);
      const glm::dvec3 is = sample_texture(*texture, {(x + 0.5) / 4096.0, 0.5});
      CHECK(is.g == doctest::Approx(expected).epsilon(1e-12));
      light.insert(is.g);
    }
    CHECK(light.size() == 4096);
  }
}

TEST_CASE("what 16 bits hold and 8 do not is in the images") {
  // Light from 0 to 255/65535: one step of 8 bits. A projector with gamma 3 tells 35 codes of it apart.
  CompileSettings settings = cards::settings({0.0}, Assignment::linear);
  settings.gamma = 3.0;
  Stage stage = cards::room(false);
  stage.objects[0].drawables[0] = support::standing(support::rectangle({0.2, 0.4}), {{0.0, 0.0, -0.515}});
  Drawable& card = stage.objects[0].drawables[0];
  hang(card, ramp(256, 1, ColorSpace::linear));
  const FrameImages deep = compiled(stage, settings);
  std::set<int> expected;
  for (int k = 0; k < 256; ++k) expected.insert(static_cast<int>(std::lround(255.0 * std::cbrt(k / 65535.0))));
  const std::set<int> shown(deep.codes.begin(), deep.codes.end());
  CHECK(expected.size() == 35);
  CHECK(std::includes(expected.begin(), expected.end(), shown.begin(), shown.end()));
  CHECK(shown.size() > expected.size() * 8 / 10);
  auto shallow = std::make_shared<Texture>(*ramp(256, 1, ColorSpace::linear));
  for (const std::uint16_t number : shallow->rgba16) {
    shallow->rgba.push_back(static_cast<std::uint8_t>(std::lround(number / 257.0)));
  }
  shallow->rgba16.clear();
  hang(card, shallow);
  CHECK(levels(compiled(stage, settings)) == 2);
}

TEST_CASE("what a texture cuts away is as if it had never been there") {
  for (const Assignment assignment : {Assignment::nearest, Assignment::linear, Assignment::optimal}) {
    const CompileSettings settings = cards::settings({-0.75, -0.25, 0.25, 0.75}, assignment);
    Stage cut = card_before_wall(0.0);
    hang(cut.objects[1].drawables[0], half_clear(2, 0.5), 0.5);
    const FrameImages is = compiled(cut, settings);
    const FrameImages should = compiled(card_before_wall(0.5), settings);
    const FrameImages whole = compiled(card_before_wall(0.0), settings);
    CAPTURE(static_cast<int>(assignment));
    CHECK(off(is, whole) > 1000);
    // Geometry and alpha may part over samples on the edge itself, a pixel wide: eight pictures of 100 rows.
    CHECK(off(is, should) < (assignment == Assignment::optimal ? 800u : 40u));
    if (assignment == Assignment::optimal) continue;
    const auto reference = compile_reference(cut, settings);
    REQUIRE(reference);
    CHECK(off(is, reference->images) < 10);
  }
}

TEST_CASE("through what is cut away the inside of a solid is seen") {
  const CompileSettings settings = cards::settings({-0.75, -0.25, 0.25, 0.75}, Assignment::linear);
  Stage stage = cards::room(false);
  StagedObject box;
  box.index = 1;
  box.drawables.push_back(support::standing(support::box({0.06, 0.06, 0.06}), {{0.0, 0.0, -0.4}}));
  REQUIRE_FALSE(box.drawables[0].mesh->uvs.empty());
  hang(box.drawables[0], half_clear(8, 0.5), 0.5);
  stage.objects.push_back(box);
  const auto reference = compile_reference(stage, settings);
  REQUIRE(reference);
  CHECK(off(compiled(stage, settings), reference->images) < 10);
}
