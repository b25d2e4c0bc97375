#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <vtkActor.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include "core/stage/stage.h"
#include "editor/tools/pick.h"
#include "editor/tools/slice_tint.h"
#include "editor/window/views/room_meshes.h"

namespace focalstage {

/// The actors of objects and fixtures: one per drawable, kept as long as its mesh and finish stay; moving a thing only
/// sets a matrix.
class RoomActors {
 public:
  explicit RoomActors(vtkRenderer& renderer) : renderer_(renderer) {}

  void begin();
  /// One drawable of a thing. `tint`: colours per vertex instead of its finish; empty: none.
  void show(RoomMeshes& meshes, const StagedName& thing, std::size_t part, const Drawable& drawable,
            const std::vector<Rgb>& tint);
  /// Drops what was not shown since `begin`.
  void end();

  /// Whether the thing is seen at all: the viewer is not while one looks through its eyes.
  void set_visible(const std::string& list, bool visible);

 private:
  struct Part {
    std::shared_ptr<const Mesh> mesh;
    Finish finish;
    std::vector<Rgb> tint;
    vtkSmartPointer<vtkPolyDataMapper> mapper;
    vtkSmartPointer<vtkActor> actor;
    bool shown = true;
  };
  using Key = std::tuple<std::string, std::string, std::size_t>;

  Part make(RoomMeshes& meshes, const Drawable& drawable, const std::vector<Rgb>& tint);

  vtkRenderer& renderer_;
  std::map<Key, Part> parts_;
};

/// Sets the actor's matrix.
void place(vtkActor& actor, const glm::dmat4& world_from_mesh);

}  // namespace focalstage
