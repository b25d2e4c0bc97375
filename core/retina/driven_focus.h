#pragma once

#include <stop_token>
#include <vector>

#include "core/retina/sight_at.h"

namespace focalstage {

/// The accommodation that the passes ask for in each pixel of the picture; the maps have `margin_px` more on each side.
/// Unfinished after a stop request.
DrivenFocus driven_focus_of(const std::vector<SeenPass>& passes, const RetinaInput& input, const RetinaView& view,
                            int margin_px, const std::stop_token& stop);

}  // namespace focalstage
