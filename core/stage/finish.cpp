#include "core/stage/finish.h"

namespace focalstage {
namespace {

Finish finish_from(const Material* material, bool has_lights) {
  Finish finish;
  finish.lit = has_lights;
  finish.vertex_colors = true;
  if (material == nullptr) return finish;
  finish.a = material->base_color;
  finish.texture = material->texture;
  finish.kind = material->texture ? Finish::Kind::textured : Finish::Kind::flat;
  finish.lit = has_lights && !material->unlit;
  return finish;
}

}  // namespace

Finish finish_of(const Appearance& appearance, const Material* material, bool has_lights) {
  Finish finish;
  if (const auto* unlit = std::get_if<UnlitAppearance>(&appearance)) {
    finish.a = unlit->color;
  } else if (const auto* checker = std::get_if<CheckerAppearance>(&appearance)) {
    finish.kind = Finish::Kind::checker;
    finish.a = checker->a;
    finish.b = checker->b;
    finish.squares = checker->squares;
  } else {
    finish = finish_from(material, has_lights);
  }
  return finish;
}

}  // namespace focalstage
