#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <vtkActor.h>
#include <vtkImageData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include "core/optics/projector_model.h"
#include "core/stage/stage.h"
#include "editor/preview/preview_values.h"
#include "editor/tools/pick.h"
#include "editor/window/views/room_meshes.h"

namespace focalstage {

/// The real surfaces, lit as a bystander sees them: the show's time average, carried there by the projector's rays.
class RoomSurfaces {
 public:
  explicit RoomSurfaces(vtkRenderer& renderer);

  /// Takes the surfaces as they stand and the newest images (null: none yet).
  void show(const Stage& stage, const Project& project, const std::shared_ptr<const CompiledSlices>& slices,
            Picker& picker, RoomMeshes& meshes);

 private:
  struct Part {
    std::shared_ptr<const Mesh> mesh;  ///< the surface's own
    std::shared_ptr<const Mesh> fine;  ///< cut so that a picture can be pinned to it
    vtkSmartPointer<vtkPolyData> poly;
    vtkSmartPointer<vtkActor> actor;
    bool shown = true;
  };
  using Key = std::pair<std::string, std::size_t>;

  Part make(const Drawable& drawable);
  void pin_pictures(const Stage& stage, const ProjectorModel& projector, Picker& picker);
  void take_light(const std::shared_ptr<const CompiledSlices>& slices);

  vtkRenderer& renderer_;
  vtkSmartPointer<vtkTexture> texture_;
  vtkSmartPointer<vtkImageData> pixels_;
  std::shared_ptr<const CompiledSlices> lit_by_;
  std::map<Key, Part> parts_;
  std::vector<StagedSurface> pinned_;
  ProjectorModel pinned_by_;
};

}  // namespace focalstage
