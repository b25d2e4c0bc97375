#pragma once

#include <span>
#include <vector>

#include "core/schedule/budget.h"
#include "core/schedule/solve.h"
#include "core/schedule/solve_attempt.h"

namespace focalstage {

/// Settings near `terms`, which have no answer, that have one; each changes one thing, by as little as helps.
std::vector<NearestSetting> nearest_settings(const SolveTerms& terms, std::span<const ProjectorModelData> models,
                                             Budget& budget);

}  // namespace focalstage
