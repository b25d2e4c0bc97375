#include "core/stage/finish.h"

#include <utility>

#include "core/scene/sequence.h"

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
  if (material->texture) finish.alpha_cutoff = material->alpha_cutoff;
  return finish;
}

}  // namespace

Result<std::shared_ptr<const Texture>> picture_of(const Appearance& appearance, const Assets& assets, double time_s) {
  const auto* image = std::get_if<ImageAppearance>(&appearance);
  const std::optional<int> index = image ? picture_at(*image, time_s) : std::nullopt;
  if (!index) return std::shared_ptr<const Texture>();
  const std::string file = picture_file(*image, *index);
  const auto found = assets.pictures.find(file);
  if (found == assets.pictures.end() || !found->second) {
    return Fault{"stage.asset-missing", "/image/file", "the picture " + file + " is not among the loaded assets",
                 "put it beside the project"};
  }
  auto texture = found->second->texture({image->wrap, image->filter, image->color_space});
  if (texture) return texture;
  Fault fault = texture.fault();
  if (fault.message.find(fault.where) == std::string::npos) fault.message = fault.where + ": " + fault.message;
  fault.where = "/image/file";
  return fault;
}

bool shows_nothing(const Appearance& appearance, double time_s) {
  const auto* image = std::get_if<ImageAppearance>(&appearance);
  return image != nullptr && !picture_at(*image, time_s);
}

Finish finish_of(const Appearance& appearance, const Material* material, bool has_lights,
                 const std::shared_ptr<const Texture>& picture) {
  Finish finish;
  if (const auto* unlit = std::get_if<UnlitAppearance>(&appearance)) {
    finish.a = unlit->color;
  } else if (const auto* checker = std::get_if<CheckerAppearance>(&appearance)) {
    finish.kind = Finish::Kind::checker;
    finish.a = checker->a;
    finish.b = checker->b;
    finish.squares = checker->squares;
  } else if (const auto* image = std::get_if<ImageAppearance>(&appearance)) {
    finish.kind = Finish::Kind::textured;
    finish.texture = picture;
    finish.lit = has_lights && image->lit;
    finish.alpha_cutoff = picture ? image->alpha_cutoff.value_or(0.0) : 0.0;
  } else {
    finish = finish_from(material, has_lights);
  }
  return finish;
}

Finish finish_of(const Albedo& albedo, const Material* material, std::shared_ptr<const Texture> picture) {
  Finish finish;
  if (std::holds_alternative<MaterialAlbedo>(albedo)) {
    finish = finish_from(material, false);
    finish.alpha_cutoff = 0.0;  // a real surface has no holes but those of its mesh
    return finish;
  }
  if (const auto* plain = std::get_if<PlainAlbedo>(&albedo)) finish.a = plain->color;
  if (!picture) return finish;
  finish.kind = Finish::Kind::textured;
  finish.texture = std::move(picture);
  return finish;
}

}  // namespace focalstage
