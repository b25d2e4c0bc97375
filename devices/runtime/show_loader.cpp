#include "devices/runtime/show_loader.h"

#include <utility>

#include "core/optics/image_plan.h"
#include "devices/player/frame_cache.h"
#include "io/project/project_file.h"
#include "io/show/reader.h"

namespace focalstage {

namespace {

/// Frames of a show on disk.
class ShowFrames : public FrameSource {
 public:
  explicit ShowFrames(ShowReader reader) : reader_(std::move(reader)) {}
  Result<FrameImages> frame(int frame) override { return reader_.frame(frame); }

 private:
  ShowReader reader_;
};

}  // namespace

Result<std::shared_ptr<const LoadedShow>> load_show(const std::filesystem::path& path, const std::string& sha256,
                                                    const RigTerms& rig) {
  Result<ShowReader> reader = ShowReader::open(path);
  if (!reader) return reader.fault();
  auto show = std::make_shared<LoadedShow>();
  show->sha256 = sha256;
  show->header = reader->header();
  const Result<LoadedProject> project = parse_project(show->header.project_text, "show " + sha256 + " /project");
  if (!project) return project.fault();
  const ScheduleResult schedule = make_schedule(project->project, image_plan(project->project));
  Result<SweepPlan> plan = admit(show->header, project->project, schedule, reader->measures(), rig);
  if (!plan) return plan.fault();
  show->plan = std::move(*plan);
  const std::size_t pixels = static_cast<std::size_t>(show->header.width_px) *
                             static_cast<std::size_t>(show->header.height_px) *
                             static_cast<std::size_t>(show->header.channels);
  show->frames = std::make_unique<FrameCache>(std::make_unique<ShowFrames>(std::move(*reader)), show->header.frames,
                                              pixels * show->header.images.size());
  return std::shared_ptr<const LoadedShow>(std::move(show));
}

}  // namespace focalstage
