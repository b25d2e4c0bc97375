#include "tests/exact/random_colours.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "tests/support/chance.h"

namespace focalstage::exact {
namespace {

using support::Chance;

glm::dvec3 paint(Chance& chance) {
  return {chance.between(0.05, 1.0), chance.between(0.05, 1.0), chance.between(0.05, 1.0)};
}

/// A photograph of 3 to 30 texels a side, none of them black.
std::shared_ptr<const Texture> photograph(Chance& chance) {
  auto texture = std::make_shared<Texture>();
  texture->width_px = chance.whole(3, 30);
  texture->height_px = chance.whole(3, 30);
  for (int i = 0; i < 4 * texture->width_px * texture->height_px; ++i)
    texture->rgba.push_back(static_cast<std::uint8_t>(chance.whole(60, 255)));
  texture->wrap_u = texture->wrap_v = Wrap::clamp;
  return texture;
}

Finish albedo(Chance& chance, std::string& story) {
  Finish finish;
  finish.a = paint(chance);
  if (!chance.one_in(2)) return finish;
  finish.kind = Finish::Kind::textured;
  finish.texture = photograph(chance);
  story += " photograph";
  return finish;
}

std::vector<double> measured(Chance& chance) {
  std::vector<double> transfer{0.0, 1.0};
  for (int i = chance.whole(0, 9); i > 0; --i) transfer.push_back(chance.between(0.0, 1.0));
  std::sort(transfer.begin(), transfer.end());
  return transfer;
}

}  // namespace

RandomScene coloured(RandomScene scene) {
  Chance chance(scene.seed ^ 0x5eedc01025u);
  CompileSettings& settings = scene.settings;
  settings.slices.compensation.mode = chance.one_in(2) ? CompensationMode::albedo : CompensationMode::even;
  settings.slices.compensation.white = chance.between(0.1, 1.0);
  settings.reference_m = chance.between(0.3, 1.5);
  if (chance.one_in(2)) settings.black_level = chance.between(0.0005, 0.05);
  if (chance.one_in(3)) settings.transfer = measured(chance);
  scene.story += settings.slices.compensation.mode == CompensationMode::even ? " | even" : " | albedo";
  if (settings.black_level > 0.0) scene.story += " leaking";
  if (!settings.transfer.empty()) scene.story += " measured";
  std::vector<Finish> finishes;
  for (std::size_t i = 0; i < scene.frames[0].surfaces.size(); ++i) finishes.push_back(albedo(chance, scene.story));
  for (Stage& stage : scene.frames) {
    for (std::size_t i = 0; i < stage.surfaces.size(); ++i) {
      for (Drawable& drawable : stage.surfaces[i].drawables) drawable.finish = finishes[i];
    }
  }
  return scene;
}

}  // namespace focalstage::exact
