#pragma once

#include <vector>

#include "core/compile/coverage.h"
#include "core/compile/frame.h"
#include "core/schedule/schedule.h"
#include "core/scene/finding.h"
#include "core/scene/project.h"

namespace focalstage {

/// What was measured of a project's frames, as far as it was.
struct Measured {
  std::vector<FrameMeasure> frames;
  std::vector<std::vector<ObjectCoverage>> coverage;  ///< per frame
};

/// Everything wrong with a project, in a fixed order (errors first, then by code and place), each with its amount and,
/// where there is one, a remedy of edits that clears it. The codes are those of design section 6.
std::vector<Finding> check(const Project& project, const ScheduleResult& schedule, const Measured& measured);

}  // namespace focalstage
