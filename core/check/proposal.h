#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/scene/edit.h"
#include "core/scene/finding.h"
#include "core/scene/project.h"
#include "core/schedule/projector_models.h"
#include "core/schedule/solve.h"

namespace focalstage {

// What the solver found (core/schedule/solve.h), in the words and edits of the project.

/// The edits that give `project` this rig. Objects pinned to a slice keep its power: their index follows it. What is
/// already so is left out.
std::vector<Edit> rig_edits(const Project& project, const SolvedRig& rig);

/// The errors that the rules would have for the project after `edits`, as far as nothing need be measured for them.
std::vector<Finding> errors_after(const Project& project, const std::vector<Edit>& edits,
                                  std::span<const ProjectorModelData> models);

/// A setting near the one wished for, as a person reads it, and its edits.
struct NearestProposal {
  NearestSetting setting;
  std::string words;  ///< "one exposure every 0.42 ms instead of 0.5 ms"
  std::vector<Edit> edits;
};

/// The nearest settings of a result, as far as the rules have no error for them.
std::vector<NearestProposal> nearest_proposals(const Project& project, const SolveResult& result,
                                               std::span<const ProjectorModelData> models);

/// Why there is no proposal: a finding of severity error for each limit, with by how much and, where one of `nearest`
/// answers it, that as its remedy. The codes are those of the rules that the limits stand for, and `solve.nothing`,
/// `solve.unserved`, `solve.settings`, `solve.gave-up`.
std::vector<Finding> solve_findings(const Project& project, const SolveResult& result,
                                    const std::vector<NearestProposal>& nearest);

/// What a proposal is, one line each: slices, sweep, projector, spacing, smear, error against what it was.
std::vector<std::string> proposal_words(const Project& project, const SolveResult& result);

}  // namespace focalstage
