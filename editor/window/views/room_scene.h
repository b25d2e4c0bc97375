#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "editor/tools/fixtures.h"
#include "editor/tools/room_view.h"
#include "editor/tools/slice_sheets.h"
#include "editor/window/base/vtk_target.h"
#include "editor/window/views/room_actors.h"
#include "editor/window/views/room_ground.h"
#include "editor/window/views/room_meshes.h"
#include "editor/window/views/room_surfaces.h"

namespace focalstage {

class Session;

/// What the room's picture is made of: the stage and its fixtures as VTK actors, kept from one revision to the next.
class RoomScene {
 public:
  RoomScene();
  ~RoomScene();

  /// Takes over what changed of the session's stage, images and view state.
  void take(const Session& session);

  /// Renders it. `supersample` 2: the picture at rest.
  void render(const RoomView& view, const Session& session, int supersample, double scale);

  Picture picture() const { return target_.picture(); }
  void finalize() { target_.finalize(); }

  Picker& picker() { return picker_; }
  /// As they stand now; made again only when something has changed.
  const std::vector<Fixture>& fixtures(const Session& session);
  const std::vector<SliceSheet>& sheets() const { return sheets_; }
  const Floor& floor() const { return floor_; }

  /// Drawables with the meshes that are drawn for them: for outlines, which cost as much as what they go round.
  std::vector<Drawable> light(std::vector<Drawable> drawables);

  /// Whether stand-ins for large meshes are still being made.
  bool waits_for_meshes() const { return meshes_.busy(); }
  /// Whether some have come that were not taken yet.
  bool has_news() const { return meshes_.has_news(); }

 private:
  struct Tinted {
    std::vector<Rgb> colours;
    Drawable drawable;
    Depth depth;
  };

  void take_objects(const Session& session, const Project& project, const Stage& stage);
  const std::vector<Rgb>& tint_of(const Project& project, const Stage& stage, const StagedObject& object,
                                  std::size_t part, const Drawable& shown);
  void forget_stale_tints(const Project& project, const Stage& stage, ObjectTint kind);
  void set_camera(const RoomView& view);

  VtkTarget target_;
  RoomMeshes meshes_;
  RoomActors actors_;
  RoomSurfaces surfaces_;
  RoomFloor ground_;
  RoomSheets sheet_faces_;
  Picker picker_;
  std::vector<Fixture> fixtures_;
  std::shared_ptr<const Stage> fixed_stage_;
  std::uint64_t fixed_revision_ = 0;
  std::vector<SliceSheet> sheets_;
  Floor floor_;
  std::map<std::pair<std::string, std::size_t>, Tinted> tints_;
  ObjectTint tinted_kind_ = ObjectTint::none;
  Slices tinted_slices_;
  std::vector<StagedSurface> tinted_surfaces_;
  Rigid tinted_viewer_;
  std::shared_ptr<const Stage> taken_stage_;
  std::uint64_t taken_revision_ = 0;
  ObjectTint taken_tint_ = ObjectTint::none;
  std::shared_ptr<const CompiledSlices> taken_slices_;
};

}  // namespace focalstage
