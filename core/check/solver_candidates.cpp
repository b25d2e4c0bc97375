#include <algorithm>
#include <utility>

#include "core/check/candidates.h"
#include "core/check/proposal.h"
#include "core/schedule/solve.h"

namespace focalstage {

bool solver_answers(const std::string& code) {
  return code == "depth.out-of-range" || code == "slices.outside-sweep" || code == "schedule.hidden-by-shutter";
}

bool needs_would_help(const std::vector<Finding>& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& finding) { return solver_answers(finding.code); });
}

Candidates solver_candidates(const Project& project, const Measured& measured,
                             std::span<const ProjectorModelData> models) {
  if (!measured.needs) return {};
  const SolveResult result = solve(project, *measured.needs, {}, models);
  if (!result.rig) return {};
  return {{rig_edits(project, *result.rig)}};
}

}  // namespace focalstage
