#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/schedule/schedule.h"
#include "editor/pipeline/solve_project.h"

namespace focalstage {

/// What the solver found for the open project: to be looked at before it is applied.
struct SolveOffer {
  std::uint64_t revision = 0;  ///< of the project it is for; it means nothing for another
  SolveReport report;
  std::vector<std::string> words;  ///< one line each: what changes, or why there is nothing to offer
  Schedule schedule;               ///< as proposed; without slots where there is no proposal

  bool solved() const { return report.solved(); }
};

}  // namespace focalstage
