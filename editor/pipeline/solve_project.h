#pragma once

#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/check/proposal.h"
#include "core/optics/needs.h"
#include "core/schedule/solve.h"
#include "core/stage/stage.h"
#include "editor/pipeline/compile_show.h"

namespace focalstage {

/// What solving came to.
struct SolveReport {
  SolveResult result;
  Needs needs;
  std::vector<Edit> edits;               ///< to be applied; empty where there is no proposal, or nothing to change
  std::vector<NearestProposal> nearest;  ///< where there is none
  /// Where there is no proposal: why, errors. Else what the rules and compiling still say of the project as proposed.
  std::vector<Finding> findings;

  bool solved() const { return result.rig.has_value(); }
};

/// Told the share that is done, 0..1, and what of.
using SolveProgress = std::function<void(double share, const std::string& detail)>;

/// Solves a project over all its frames: measures what is needed, solves, and compiles the proposal to see what it is
/// worth. A picture that wants more than measuring saw (a look bent round a surface's edge) is solved for
/// again, twice at most. A
/// proposal is made only where the rules, and what compiling measured, have no error for it. Faults: "solve.cancelled",
/// "project.no-projector" and those of staging and compiling.
Result<SolveReport> solve_project(const Project& project, const Assets& assets,
                                  std::span<const ProjectorModelData> models, const SolveWishes& wishes,
                                  const SolveProgress& progress, std::stop_token stop);

}  // namespace focalstage
