#include "tests/exact/random_things.h"

#include <array>
#include <cstdint>
#include <memory>
#include <numbers>

namespace focalstage::exact {

using support::Chance;
using support::SharedMesh;

namespace {

SharedMesh random_triangles(Chance& chance, double size_m) {
  auto mesh = std::make_shared<Mesh>();
  const int count = chance.whole(1, 60);
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<unsigned>(mesh->positions_m.size());
    const glm::dvec3 middle = chance.within(size_m / 2.0);
    for (int corner = 0; corner < 3; ++corner) {
      mesh->positions_m.push_back(middle + chance.within(size_m * 0.7));
      mesh->uvs.push_back({chance.between(-2.0, 2.0), chance.between(-2.0, 2.0)});
    }
    mesh->triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

glm::dvec3 random_colour(Chance& chance) { return glm::dvec3(0.5) + chance.within(0.5); }

std::shared_ptr<Texture> random_texture(Chance& chance) {
  auto texture = std::make_shared<Texture>();
  texture->width_px = chance.whole(1, 40);
  texture->height_px = chance.whole(1, 40);
  for (int i = 0; i < 4 * texture->width_px * texture->height_px; ++i) {
    texture->rgba.push_back(static_cast<std::uint8_t>(chance.whole(0, 255)));
  }
  constexpr std::array<Wrap, 3> wraps{Wrap::repeat, Wrap::mirror, Wrap::clamp};
  texture->wrap_u = wraps[static_cast<std::size_t>(chance.whole(0, 2))];
  texture->wrap_v = wraps[static_cast<std::size_t>(chance.whole(0, 2))];
  return texture;
}

/// What pictures can be beside that, drawn from the texture itself: scenes of before textures had it stay as they are
/// otherwise.
void draw_picture(Texture& texture, Finish& finish, std::string& story) {
  std::uint64_t seed = texture.rgba.size();
  for (const std::uint8_t number : texture.rgba) seed = seed * 1099511628211u + number;
  Chance chance(seed);
  if (chance.one_in(3)) texture.magnify = Magnify::nearest;
  if (chance.one_in(3)) {
    for (const std::uint8_t high : texture.rgba) {
      texture.rgba16.push_back(static_cast<std::uint16_t>(256 * high + chance.whole(0, 255)));
    }
    texture.rgba.clear();
    story += ":deep";
  }
  if (chance.one_in(3)) texture.color_space = ColorSpace::linear;
  if (!chance.one_in(3)) return;
  finish.alpha_cutoff = chance.between(0.05, 0.95);
  story += ":cut";
}

}  // namespace

glm::dquat turned(Chance& chance, double most_deg) {
  return glm::angleAxis(chance.between(-most_deg, most_deg) * std::numbers::pi / 180.0, chance.direction());
}

SharedMesh random_surface(Chance& chance, double size_m, std::string& story) {
  const glm::dvec2 size{size_m, size_m * chance.between(0.6, 1.2)};
  switch (chance.whole(0, 6)) {
    case 0:
      story += " plane";
      return support::rectangle(size);
    case 1:
      story += " bumpy";
      return support::bumpy(size, size_m * chance.between(0.01, 0.1), chance.whole(3, 60));
    case 2:
      story += " step";
      return support::step(size, size_m * chance.between(-0.3, 0.3));
    case 3:
      story += " corner";
      return support::fold(size * glm::dvec2(0.6, 1.0), chance.between(60.0, 300.0));
    case 4:
      story += " bowl";
      return support::bumpy(size, size_m * 0.2, chance.whole(3, 40), 0.5);
    case 5:
      story += " ball";
      return support::blob(size_m * 0.4, chance.whole(2, 30), 0.1, chance.seed());
    default:
      story += " box";
      return support::box({size_m * 0.6, size_m * 0.5, size_m * 0.4});
  }
}

SharedMesh random_object(Chance& chance, double size_m, std::string& story) {
  const glm::dvec2 size{size_m, size_m * chance.between(0.6, 1.2)};
  switch (chance.whole(0, 5)) {
    case 0:
      story += " plane";
      return support::rectangle(size);
    case 1:
      story += " box";
      return support::box(size_m * glm::dvec3(0.7, 0.6, 0.5));
    case 2:
      story += " blob";
      return support::blob(size_m * 0.5, chance.whole(1, 40), chance.between(0.0, 0.4), chance.seed());
    case 3:
      story += " bumpy";
      return support::bumpy(size, size_m * chance.between(0.02, 0.2), chance.whole(2, 50));
    case 4:
      story += " step";
      return support::step(size, size_m * 0.3);
    default:
      story += " soup";
      return random_triangles(chance, size_m);
  }
}

Finish random_finish(Chance& chance, std::string& story) {
  Finish finish;
  std::shared_ptr<Texture> texture;
  finish.a = chance.one_in(4) ? glm::dvec3(1.0) : random_colour(chance);
  finish.lit = chance.one_in(3);
  switch (chance.whole(0, 2)) {
    case 0:
      break;
    case 1:
      finish.kind = Finish::Kind::checker;
      finish.squares = {chance.whole(1, 24), chance.whole(1, 24)};
      finish.b = chance.one_in(2) ? glm::dvec3(0.0) : random_colour(chance);
      break;
    default:
      finish.kind = Finish::Kind::textured;
      texture = random_texture(chance);
  }
  constexpr std::array<const char*, 3> names{"flat", "checker", "textured"};
  story.append(":").append(names[static_cast<std::size_t>(finish.kind)]).append(finish.lit ? ":lit" : "");
  if (texture) draw_picture(*texture, finish, story);
  finish.texture = texture;
  return finish;
}

Depth random_depth(Chance& chance, std::size_t slices, std::string& story) {
  Depth depth;
  depth.mode = static_cast<DepthMode>(chance.whole(0, 3));
  if (depth.mode == DepthMode::fixed) depth.vergence_d = chance.between(0.0, 4.0);
  if (depth.mode == DepthMode::offset) depth.vergence_d = chance.between(-1.0, 1.0);
  depth.index = chance.whole(0, static_cast<int>(slices) - 1);
  constexpr std::array<const char*, 4> names{"placed", "fixed", "offset", "slice"};
  story.append(":").append(names[static_cast<std::size_t>(depth.mode)]);
  return depth;
}

Light random_light(Chance& chance) {
  Light light;
  light.kind = static_cast<LightKind>(chance.whole(0, 2));
  light.position_m = chance.within(1.0);
  light.direction = chance.direction() * chance.between(0.1, 3.0);
  light.color = random_colour(chance);
  light.intensity = chance.between(0.2, 1.5);
  return light;
}

}  // namespace focalstage::exact
