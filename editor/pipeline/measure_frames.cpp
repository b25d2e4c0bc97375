#include "editor/pipeline/measure_frames.h"

#include <utility>

#include "core/percept/conflict_meter.h"

namespace focalstage {
namespace {

/// What the eyes see of a frame of a show.
Status look_at_shown(const FramesToMeasure& what, int k, const FrameMaker& maker, ConflictMeter& conflict,
                     const std::stop_token& stop) {
  const auto images = what.show->frame(k);
  if (!images) return images.fault();
  return conflict.add(maker.staged(), *images, stop);
}

}  // namespace

Result<Measured> measure_frames(FrameMaker& maker, const FramesToMeasure& what, const FrameProgress& progress,
                                const std::stop_token& stop) {
  ConflictMeter conflict(maker.project(), maker.settings(), what.schedule);
  Measured measured;
  if (what.show) measured.frames = what.show->measures();
  const int count = what.frames.end - what.frames.begin;
  for (int k = 0; k < count; ++k) {
    if (stop.stop_requested()) {
      return Fault{"compile.cancelled", maker.project().name, "stopped before the end", ""};
    }
    if (Status stood = maker.stand_up(what.frames.begin + k); !stood) return stood.fault();
    if (k == 0) {
      measured.meshes = mesh_states(maker.project(), maker.staged());
      measured.lit = surfaces_in_light(maker.project(), maker.staged());
    }
    const bool looked_at = looked_at_for_conflict(k, count);
    Status seen;
    if (what.show) {
      if (looked_at) seen = look_at_shown(what, k, maker, conflict, stop);
    } else {
      auto made = maker.compile(stop);
      if (!made) return made.fault();
      if (looked_at) seen = conflict.add(maker.staged(), *made->images, stop);
      measured.frames.push_back(std::move(made->measure));
    }
    if (!seen) return seen.fault();
    measured.coverage.push_back(maker.coverage());
    progress(k + 1, count);
  }
  measured.conflicts = conflict.conflicts();
  return measured;
}

}  // namespace focalstage
