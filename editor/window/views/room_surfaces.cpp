#include "editor/window/views/room_surfaces.h"

#include <cstring>

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include "editor/tools/surface_light.h"
#include "editor/window/views/room_actors.h"

namespace focalstage {
namespace {

constexpr double unlit_tone = 0.035;       ///< linear: what room light leaves of a white wall
constexpr unsigned char shadow_tint = 92;  ///< of 255: what the room's light leaves where the projector's does not come

}  // namespace

RoomSurfaces::RoomSurfaces(vtkRenderer& renderer)
    : renderer_(renderer), texture_(vtkSmartPointer<vtkTexture>::New()), pixels_(vtkSmartPointer<vtkImageData>::New()) {
  texture_->SetInputData(pixels_);
  texture_->InterpolateOn();
  texture_->RepeatOff();
  texture_->EdgeClampOn();  // beyond its edge, which holds the tone alone
  take_light(nullptr);
}

/// The texture is always there: without images it is the bare tone, so that nothing jumps when the first come.
void RoomSurfaces::take_light(const std::shared_ptr<const CompiledSlices>& slices) {
  if (slices && slices == lit_by_) return;
  LightPicture picture;
  if (slices && slices->images.count > 0) {
    picture = light_picture(slices->images, slices->settings.images, slices->settings.bits, slices->settings.gamma,
                            unlit_tone);
  } else {
    picture = light_picture(FrameImages{0, 4, 4, 1, {}}, {}, 8, 1.0, unlit_tone);
  }
  lit_by_ = slices;
  int was[3];
  pixels_->GetDimensions(was);
  if (was[0] != picture.width_px || was[1] != picture.height_px) {
    pixels_->SetDimensions(picture.width_px, picture.height_px, 1);
    pixels_->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  }
  std::memcpy(pixels_->GetScalarPointer(), picture.rgb.data(), picture.rgb.size());
  pixels_->GetPointData()->GetScalars()->Modified();
  pixels_->Modified();
}

RoomSurfaces::Part RoomSurfaces::make(const Drawable& drawable) {
  Part part{drawable.mesh, finely_cut(drawable.mesh), nullptr, vtkSmartPointer<vtkActor>::New()};
  part.poly = poly_data_of(*part.fine);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(part.poly);
  part.actor->SetMapper(mapper);
  part.actor->SetTexture(texture_);
  vtkProperty& property = *part.actor->GetProperty();
  property.SetAmbient(0.9);
  property.SetDiffuse(0.1);
  property.SetSpecular(0.0);
  renderer_.AddActor(part.actor);
  return part;
}

void RoomSurfaces::pin_pictures(const Stage& stage, const ProjectorModel& projector, Picker& picker) {
  for (const StagedSurface& surface : stage.surfaces) {
    for (std::size_t i = 0; i < surface.drawables.size(); ++i) {
      const auto found = parts_.find({surface.name, i});
      if (found == parts_.end()) continue;
      Part& part = found->second;
      const PinnedPicture pinned =
          pinned_picture(stage, projector, *part.fine, surface.drawables[i].world_from_mesh, picker);
      vtkNew<vtkFloatArray> uvs;
      uvs->SetName("uvs");
      uvs->SetNumberOfComponents(2);
      uvs->SetNumberOfTuples(static_cast<vtkIdType>(pinned.uv.size()));
      if (!pinned.uv.empty()) std::memcpy(uvs->GetPointer(0), pinned.uv.data(), pinned.uv.size() * sizeof(glm::vec2));
      vtkNew<vtkUnsignedCharArray> tints;
      tints->SetName("tints");
      tints->SetNumberOfComponents(3);
      tints->SetNumberOfTuples(static_cast<vtkIdType>(pinned.reached.size()));
      unsigned char* to = tints->GetPointer(0);
      for (const std::uint8_t reached : pinned.reached) {
        for (int c = 0; c < 3; ++c) *to++ = reached != 0 ? 255 : shadow_tint;
      }
      part.poly->GetPointData()->SetTCoords(uvs);
      part.poly->GetPointData()->SetScalars(tints);
      part.poly->Modified();
    }
  }
}

void RoomSurfaces::show(const Stage& stage, const Project& project, const std::shared_ptr<const CompiledSlices>& slices,
                        Picker& picker, RoomMeshes& meshes) {
  for (auto& [key, part] : parts_) part.shown = false;
  bool is_new = false;
  for (const StagedSurface& surface : stage.surfaces) {
    for (std::size_t i = 0; i < surface.drawables.size(); ++i) {
      const Drawable drawable = meshes.shown(surface.drawables[i]);
      if (!drawable.mesh) continue;  // its stand-in is being made
      auto found = parts_.find({surface.name, i});
      if (found != parts_.end() && found->second.mesh != drawable.mesh) {
        renderer_.RemoveActor(found->second.actor);
        parts_.erase(found);
        found = parts_.end();
      }
      if (found == parts_.end()) {
        found = parts_.emplace(Key{surface.name, i}, make(drawable)).first;
        is_new = true;
      }
      found->second.shown = true;
      place(*found->second.actor, drawable.world_from_mesh);
    }
  }
  std::erase_if(parts_, [&](auto& item) {
    if (item.second.shown) return false;
    renderer_.RemoveActor(item.second.actor);
    return true;
  });
  take_light(slices);
  if (project.projectors.empty()) return;
  const ProjectorModel projector = projector_model(project.projectors.front());
  if (!is_new && pinned_ == stage.surfaces && pinned_by_ == projector) return;
  pin_pictures(stage, projector, picker);
  pinned_ = stage.surfaces;
  pinned_by_ = projector;
}

}  // namespace focalstage
