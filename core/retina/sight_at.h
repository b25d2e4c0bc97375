#pragma once

#include <optional>
#include <vector>

#include "core/optics/eye.h"
#include "core/retina/retina.h"
#include "core/retina/slice_light.h"
#include "core/retina/slice_map.h"

namespace focalstage {

/// What is seen in a pixel of the maps' grid; where that is dark, in the smallest square around it, of nine pixels at
/// most, that is not. `maps`: one per slice of `lights`, and last the bare surface's (zero power).
std::optional<RetinaSight> sight_at(const std::vector<const SliceMap*>& maps, const std::vector<SliceLight>& lights,
                                    const Eye& eye, int column, int row);

}  // namespace focalstage
