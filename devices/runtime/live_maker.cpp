#include "devices/runtime/live_maker.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "core/optics/image_plan.h"
#include "core/scene/project_value.h"
#include "core/schedule/schedule.h"
#include "io/assets/assets.h"

namespace focalstage {

namespace {

Status fit_to_compile(const Project& project) {
  if (const auto amiss = fault_of(project)) return *amiss;
  if (!project.projectors.empty()) return {};
  return Fault{"project.no-projector", "/projectors", "the project has no projector", "add one"};
}

}  // namespace

/// Reads meshes and pictures where the files are others than before, or a thing refers to one that nothing referred to.
Status LiveMaker::read_assets(const LiveSnapshot& snapshot) {
  const Project& project = *snapshot.project;
  if (snapshot.files == files_ && has_all(assets_, project)) return {};
  std::vector<AssetFile> files;
  for (const auto& [path, sha256] : snapshot.files) {
    Result<std::vector<std::byte>> bytes = store_.read(sha256);
    if (!bytes) return bytes.fault();
    files.push_back({path, sha256, std::move(*bytes)});
  }
  Result<Assets> assets = assets_from(project, files);
  if (!assets) return assets.fault();
  assets_ = std::move(*assets);
  files_ = snapshot.files;
  return {};
}

/// The memory of an image set that left the rig: faster than fresh pages, and the rig's own thread never frees any.
FrameImages LiveMaker::recycled() {
  const auto free = std::ranges::find_if(given_out_, [](const auto& images) { return images.use_count() == 1; });
  if (free == given_out_.end()) return {};
  std::atomic_thread_fence(std::memory_order_acquire);  // whoever let go of it last has read it by now
  FrameImages images = std::move(**free);
  given_out_.erase(free);
  return images;
}

Result<CompiledFrame> LiveMaker::compile(const LiveSnapshot& snapshot, const CompileSettings& settings,
                                         const std::stop_token& stop) {
  if (Status read = read_assets(snapshot); !read) return read.fault();
  const Result<Stage> staged = stage(*snapshot.project, assets_, snapshot.frame / snapshot.project->frames.rate_hz);
  if (!staged) return staged.fault();
  if (!compiler_ || settings_ != settings) {
    settings_ = settings;
    compiler_.emplace(settings);
  }
  return compiler_->frame(*staged, stop, recycled());
}

Result<std::shared_ptr<LoadedShow>> LiveMaker::make(const LiveSnapshot& snapshot, const std::stop_token& stop) {
  const Project& project = *snapshot.project;
  if (Status fit = fit_to_compile(project); !fit) return fit.fault();
  const CompileSettings settings = compile_settings(project);
  Result<CompiledFrame> compiled = compile(snapshot, settings, stop);
  if (!compiled) return compiled.fault();
  auto show = std::make_shared<LoadedShow>();
  show->revision = snapshot.revision;
  const ScheduleResult schedule = make_schedule(project, settings.images);
  show->header = make_show_header(project, {}, {}, schedule.schedule, settings, {snapshot.frame, snapshot.frame + 1});
  Result<SweepPlan> plan = admit(show->header, project, schedule, {std::move(compiled->measure)}, rig_);
  if (!plan) return plan.fault();
  show->plan = std::move(*plan);
  auto images = std::make_shared<FrameImages>(std::move(compiled->images));
  given_out_.push_back(images);
  show->frames = std::make_unique<OneFrame>(std::move(images));
  return show;
}

}  // namespace focalstage
