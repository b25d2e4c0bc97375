#include "editor/window/views/room_actors.h"

#include <cmath>
#include <utility>

#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkProperty.h>

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "editor/tools/srgb.h"

namespace focalstage {
namespace {

constexpr int most_squares = 256;

vtkSmartPointer<vtkImageData> image(int width, int height, int channels) {
  auto pixels = vtkSmartPointer<vtkImageData>::New();
  pixels->SetDimensions(width, height, 1);
  pixels->AllocateScalars(VTK_UNSIGNED_CHAR, channels);
  return pixels;
}

/// A texel per square: over UV from 0 to 1, and repeated.
vtkSmartPointer<vtkTexture> checker_texture(const Finish& finish) {
  const glm::ivec2 squares = glm::clamp(finish.squares, 1, most_squares);
  auto pixels = image(squares.x, squares.y, 3);
  const glm::dvec3 a = srgb_from_linear(finish.a);
  const glm::dvec3 b = srgb_from_linear(finish.b);
  for (int y = 0; y < squares.y; ++y) {
    for (int x = 0; x < squares.x; ++x) {
      auto* to = static_cast<unsigned char*>(pixels->GetScalarPointer(x, y, 0));
      for (int c = 0; c < 3; ++c) {
        to[c] = static_cast<unsigned char>(255.0 * ((x + y) % 2 == 0 ? a : b)[c] + 0.5);
      }
    }
  }
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(pixels);
  texture->InterpolateOff();
  texture->RepeatOn();
  return texture;
}

/// One of the texture's numbers as screens take it.
unsigned char srgb_byte(const Texture& source, std::size_t at) {
  const double share = source.is_deep() ? source.rgba16[at] / 65535.0 : source.rgba[at] / 255.0;
  if (source.color_space == ColorSpace::linear) return srgb_code(share);
  return static_cast<unsigned char>(255.0 * share + 0.5);
}

vtkSmartPointer<vtkTexture> picture_texture(const Texture& source) {
  auto pixels = image(source.width_px, source.height_px, 3);
  for (int y = 0; y < source.height_px; ++y) {
    auto* to = static_cast<unsigned char*>(pixels->GetScalarPointer(0, source.height_px - 1 - y, 0));
    std::size_t from = static_cast<std::size_t>(y) * static_cast<std::size_t>(source.width_px) * 4;
    for (int x = 0; x < source.width_px; ++x, from += 4) {
      for (std::size_t c = 0; c < 3; ++c) *to++ = srgb_byte(source, from + c);
    }
  }
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(pixels);
  texture->SetInterpolate(source.magnify == Magnify::linear);
  texture->MipmapOn();
  if (source.wrap_u == Wrap::clamp) texture->EdgeClampOn();
  return texture;
}

/// The mesh's own colours, by which VTK multiplies the texture.
std::vector<Rgb> vertex_shades(const Drawable& drawable) {
  std::vector<Rgb> shades;
  if (!drawable.finish.vertex_colors) return shades;
  for (const glm::dvec3& color : drawable.mesh->colors) {
    const glm::dvec3 linear = drawable.finish.a * color;
    shades.emplace_back(srgb_code(linear.r), srgb_code(linear.g), srgb_code(linear.b));
  }
  return shades;
}

void finish_actor(vtkActor& actor, const Finish& finish, bool has_uv, bool tinted) {
  vtkProperty& property = *actor.GetProperty();
  property.SetInterpolationToPhong();
  property.SetAmbient(0.34);
  property.SetDiffuse(0.66);
  property.SetSpecular(0.0);
  glm::dvec3 colour = srgb_from_linear(finish.a);
  if (!tinted && has_uv && finish.kind == Finish::Kind::checker) {
    actor.SetTexture(checker_texture(finish));
    colour = glm::dvec3(1.0);
  } else if (!tinted && has_uv && finish.kind == Finish::Kind::textured && finish.texture) {
    actor.SetTexture(picture_texture(*finish.texture));
  }
  property.SetColor(colour.r, colour.g, colour.b);
}

}  // namespace

void place(vtkActor& actor, const glm::dmat4& world_from_mesh) {
  vtkNew<vtkMatrix4x4> matrix;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) matrix->SetElement(row, column, world_from_mesh[column][row]);
  }
  actor.SetUserMatrix(matrix);
}

void RoomActors::begin() {
  for (auto& [key, part] : parts_) part.shown = false;
}

RoomActors::Part RoomActors::make(RoomMeshes& meshes, const Drawable& drawable, const std::vector<Rgb>& tint) {
  RoomMeshes::Entry& entry = meshes.of(drawable.mesh);
  Part part{drawable.mesh, drawable.finish, tint, vtkSmartPointer<vtkPolyDataMapper>::New(),
            vtkSmartPointer<vtkActor>::New()};
  const std::vector<Rgb> shades = tint.empty() ? vertex_shades(drawable) : tint;
  part.mapper->SetInputData(shades.empty() ? entry.poly : coloured(*entry.poly, shades));
  part.mapper->SetScalarVisibility(!shades.empty());
  part.mapper->StaticOn();  // never asks its input again: 500 objects do not pay for what cannot change
  part.actor->SetMapper(part.mapper);
  finish_actor(*part.actor, drawable.finish, !drawable.mesh->uvs.empty(), !tint.empty());
  if (entry.closed && glm::determinant(glm::dmat3(drawable.world_from_mesh)) > 0.0) {
    part.actor->GetProperty()->BackfaceCullingOn();
  }
  renderer_.AddActor(part.actor);
  return part;
}

void RoomActors::show(RoomMeshes& meshes, const StagedName& thing, std::size_t number, const Drawable& drawable,
                      const std::vector<Rgb>& tint) {
  const Key key{thing.list, thing.name, number};
  auto found = parts_.find(key);
  if (found != parts_.end() &&
      (found->second.mesh != drawable.mesh || found->second.finish != drawable.finish || found->second.tint != tint)) {
    renderer_.RemoveActor(found->second.actor);
    parts_.erase(found);
    found = parts_.end();
  }
  if (found == parts_.end()) {
    found = parts_.emplace(key, make(meshes, drawable, tint)).first;
  } else {
    (void)meshes.of(drawable.mesh);  // still in use
  }
  Part& part = found->second;
  part.shown = true;
  place(*part.actor, drawable.world_from_mesh);
}

void RoomActors::end() {
  std::erase_if(parts_, [&](auto& item) {
    if (item.second.shown) return false;
    renderer_.RemoveActor(item.second.actor);
    return true;
  });
}

void RoomActors::set_visible(const std::string& list, bool visible) {
  for (auto& [key, part] : parts_) {
    if (std::get<0>(key) == list) part.actor->SetVisibility(visible);
  }
}

}  // namespace focalstage
