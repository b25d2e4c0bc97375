#pragma once

#include <stop_token>
#include <vector>

#include "core/base/result.h"
#include "core/check/check.h"
#include "core/schedule/schedule.h"
#include "editor/pipeline/frame_maker.h"
#include "io/show/reader.h"
#include "io/show/show.h"

namespace focalstage {

/// What there is to measure.
struct FramesToMeasure {
  FrameRange frames;                 ///< of the project
  std::vector<Schedule> schedules;   ///< of each projector: by which the eyes see their images
  const ShowReader* show = nullptr;  ///< holds them compiled, the first one first; null: `maker` compiles each
};

/// When each projector of the project shows its images; and that alone.
std::vector<ScheduleResult> schedules_of(const FrameMaker& maker);
std::vector<Schedule> plain(const std::vector<ScheduleResult>& results);

/// Stands up frame after frame and measures what `check` asks for, but what all need; no image is kept. Faults:
/// "compile.cancelled" and those of staging, compiling, reading the show, and looking.
Result<Measured> measure_frames(FrameMaker& maker, const FramesToMeasure& what, const FrameProgress& progress,
                                const std::stop_token& stop);

}  // namespace focalstage
