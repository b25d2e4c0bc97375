#include "editor/pipeline/measure_needs.h"

#include <optional>
#include <utility>

#include "core/compile/frame.h"
#include "core/compile/need_meter.h"

namespace focalstage {

bool same_room(const Stage& a, const Stage& b) {
  return a.world_from_viewer == b.world_from_viewer && a.interpupillary_m == b.interpupillary_m &&
         a.surfaces == b.surfaces && a.objects == b.objects && a.lights == b.lights;
}

Result<Needs> measure_needs(const Project& project, const Assets& assets, FrameRange frames,
                            const FrameProgress& progress, std::stop_token stop) {
  const CompileSettings settings = compile_settings(project);
  NeedMeter meter(projectors_of(settings), settings.lens_to_pupil_m, settings.slices.breathing);
  Needs needs;
  std::optional<Stage> before;
  std::vector<ObjectNeeds> now;
  for (int k = frames.begin; k < frames.end; ++k) {
    if (stop.stop_requested()) return Fault{"solve.cancelled", project.name, "stopped before the end", ""};
    auto staged = stage(project, assets, k / project.frames.rate_hz);
    if (!staged) return staged.fault();
    if (!before || !same_room(*before, *staged)) {
      now = meter.measure(*staged);
      before = std::move(*staged);
    }
    needs.add(now);
    progress(k + 1 - frames.begin, frames.end - frames.begin);
  }
  return needs;
}

}  // namespace focalstage
