#pragma once

#include <vector>

#include "core/scene/edit.h"
#include "core/scene/project.h"

namespace focalstage {

/// Edits that turn `from` into `to`, one for each member of the project that differs.
std::vector<Edit> edits_between(const Project& from, const Project& to);

}  // namespace focalstage
