#pragma once

#include <span>
#include <vector>

#include "core/check/check.h"
#include "core/schedule/projector_models.h"

namespace focalstage {

/// Edits that clear `finding` and bring no new error; empty where none are found. `present` is what
/// `planned_findings` says of the project as it is.
std::vector<Edit> remedy_for(const Project& project, const Finding& finding, const Measured& measured,
                             const std::vector<Finding>& present, std::span<const ProjectorModelData> models);

}  // namespace focalstage
