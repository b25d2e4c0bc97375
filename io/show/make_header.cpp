#include <algorithm>
#include <cmath>
#include <utility>

#include "core/stage/stage.h"
#include "io/show/show.h"

namespace focalstage {
namespace {

FramePoses poses_at(const Project& project, double time_s) {
  FramePoses poses;
  poses.viewer = pose_row(pose_at(project.viewer.placement, time_s));
  for (const Surface& surface : project.surfaces)
    poses.surfaces.push_back(pose_row(pose_at(surface.placement, time_s)));
  for (const Object& object : project.objects) poses.objects.push_back(pose_row(pose_at(object.placement, time_s)));
  return poses;
}

/// The project's frame nearest to the cue; one after the end falls on the last, one before the start on the first.
int frame_of(const Cue& cue, const Frames& frames) {
  const double nearest = std::round(cue.time_s * frames.rate_hz);
  return static_cast<int>(std::clamp(nearest, 0.0, static_cast<double>(frames.count - 1)));
}

}  // namespace

ShowProjector show_projector(const Project& project, std::size_t i, const CompileSettings& settings,
                             const Schedule& schedule) {
  return {project.projectors.at(i).frames_per_second,
          settings.projector.width_px,
          settings.projector.height_px,
          settings.channels,
          settings.images,
          schedule.slots};
}

ShowHeader make_show_header(const Project& project, std::string text, const LoadedAssets& assets,
                            const Schedule& schedule, const CompileSettings& settings, FrameRange range) {
  ShowHeader header;
  header.project_text = std::move(text);
  header.assets = assets.files;
  header.frequency_hz = project.sweep.frequency_hz;
  header.frames_per_second = project.projectors.at(0).frames_per_second;
  header.rate_hz = project.frames.rate_hz;
  header.first_frame = range.begin;
  header.frames = range.end - range.begin;
  header.width_px = settings.projector.width_px;
  header.height_px = settings.projector.height_px;
  header.channels = settings.channels;
  header.images = settings.images;
  header.schedule = schedule;
  for (int k = range.begin; k < range.end; ++k) header.poses.push_back(poses_at(project, k / project.frames.rate_hz));
  for (const Cue& cue : project.cues) {
    const int frame = frame_of(cue, project.frames);
    if (frame >= range.begin && frame < range.end) header.cues.push_back({cue.name, frame - range.begin});
  }
  return header;
}

}  // namespace focalstage
