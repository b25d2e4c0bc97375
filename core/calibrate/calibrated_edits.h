#pragma once

#include <vector>

#include "core/optics/projector_model.h"
#include "core/scene/edit.h"
#include "core/scene/project.h"

namespace focalstage {

/// What turns the project's projector into the measured one: `set` edits of lens and pose, none of what is the same.
std::vector<Edit> calibrated_edits(const Projector& projector, const ProjectorModel& measured);

}  // namespace focalstage
