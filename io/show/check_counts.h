#pragma once

#include <string>

#include "core/base/result.h"
#include "io/show/show.h"

namespace focalstage {

/// Holds a header against the project it carries: whoever plays or checks the show indexes one with the other. Faults:
/// the project's own, or "show.invalid" naming the dataset in `source`.
Status check_counts(const ShowHeader& header, const std::string& source);

}  // namespace focalstage
