#include "editor/pipeline/seen_show.h"

#include <utility>

#include "editor/pipeline/source.h"

namespace focalstage {
namespace {

Rigid rigid_of(const PoseRow& row) { return {{row[0], row[1], row[2]}, {row[6], row[3], row[4], row[5]}}; }

/// Puts viewer and surfaces where the show says they were: a tracked thing's pose is not the project's.
void place(const FramePoses& poses, Stage& stage) {
  stage.world_from_viewer = rigid_of(poses.viewer);
  for (StagedSurface& surface : stage.surfaces) {
    if (surface.index >= poses.surfaces.size()) continue;
    const Rigid now = rigid_of(poses.surfaces[surface.index]);
    if (now == surface.world_from_surface) continue;
    const glm::dmat4 moved = (now * surface.world_from_surface.inverse()).matrix();
    for (Drawable& drawable : surface.drawables) drawable.world_from_mesh = moved * drawable.world_from_mesh;
    surface.world_from_surface = now;
  }
}

}  // namespace

Result<SeenShow> SeenShow::of(const ShowReader& show, const std::string& name, int frame, Side eye,
                              const std::optional<WornGlasses>& glasses) {
  const ShowHeader& header = show.header();
  auto source = project_in(show, name);
  if (!source) return source.fault();
  auto staged = stage(source->project, source->loaded.assets, (header.first_frame + frame) / header.rate_hz);
  if (!staged) return staged.fault();
  SeenShow seen;
  seen.stage_ = *std::move(staged);
  place(header.poses[static_cast<std::size_t>(frame)], seen.stage_);
  for (std::size_t i = 0; i < header.projectors(); ++i) {
    auto images = show.frame(frame, i);
    if (!images) return images.fault();
    seen.images_.push_back(*std::move(images));
    seen.settings_.push_back(compile_settings(source->project, i));
    seen.schedules_.push_back(header.schedule);
    seen.schedules_[i].slots = header.projector(i).slots;
  }
  seen.glasses_ = glasses ? *glasses : worn_glasses(source->project.glasses);
  seen.room_ = room_light_of(source->project);
  seen.eye_ = eye;
  return seen;
}

std::vector<RetinaInput> SeenShow::inputs() const {
  std::vector<RetinaInput> inputs;
  for (std::size_t i = 0; i < images_.size(); ++i) {
    const RoomLight room = i == 0 ? room_ : RoomLight{};
    inputs.push_back(seen_frame(stage_, settings_[i], images_[i], schedules_[i], glasses_, eye_, room));
  }
  return inputs;
}

}  // namespace focalstage
