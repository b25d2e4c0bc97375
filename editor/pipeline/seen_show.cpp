#include "editor/pipeline/seen_show.h"

#include <algorithm>
#include <iterator>
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

Result<SeenShow> SeenShow::of(const ShowReader& show, const std::string& name, int frame, Side eye) {
  const ShowHeader& header = show.header();
  auto source = project_in(show, name);
  if (!source) return source.fault();
  auto staged = stage(source->project, source->loaded.assets, (header.first_frame + frame) / header.rate_hz);
  if (!staged) return staged.fault();
  auto images = show.frame(frame);
  if (!images) return images.fault();

  SeenShow seen;
  seen.stage_ = *std::move(staged);
  place(header.poses[static_cast<std::size_t>(frame)], seen.stage_);
  seen.settings_ = compile_settings(source->project);
  seen.images_ = *std::move(images);
  seen.lens_aperture_m_ = source->project.glasses.lens_aperture_mm / 1000.0;
  std::copy_if(header.schedule.slots.begin(), header.schedule.slots.end(), std::back_inserter(seen.slots_),
               [&](const Slot& slot) { return slot.eye == eye; });
  return seen;
}

RetinaInput SeenShow::input() const {
  RetinaInput input;
  input.stage = &stage_;
  input.projector = settings_.projector;
  input.channels = images_.channels;
  input.bits = settings_.bits;
  input.gamma = settings_.gamma;
  input.lens_to_pupil_m = settings_.lens_to_pupil_m;
  input.lens_aperture_m = lens_aperture_m_;
  for (const Slot& slot : slots_) {
    input.slices.push_back({images_.image(static_cast<std::size_t>(slot.image)), slot.power_d});
  }
  return input;
}

}  // namespace focalstage
