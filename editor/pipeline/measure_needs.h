#pragma once

#include <stop_token>

#include "core/base/result.h"
#include "core/optics/needs.h"
#include "core/stage/stage.h"
#include "editor/pipeline/compile_show.h"

namespace focalstage {

/// What the frames [begin, end) of a project need, every one of them stood up and looked at. Faults: "solve.cancelled"
/// and those of staging.
Result<Needs> measure_needs(const Project& project, const Assets& assets, FrameRange frames,
                            const FrameProgress& progress, std::stop_token stop);

/// Whether two moments look alike: everything but the time.
bool same_room(const Stage& a, const Stage& b);

}  // namespace focalstage
