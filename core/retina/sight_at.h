#pragma once

#include <optional>
#include <vector>

#include "core/optics/eye.h"
#include "core/retina/retina.h"
#include "core/retina/slice_light.h"
#include "core/retina/slice_map.h"

namespace focalstage {

/// One power's map, the light seen through it and its share.
struct SeenPass {
  const SliceMap* map = nullptr;
  const SliceLight* light = nullptr;
  float share = 1.0f;
};

/// What is seen in a pixel of the maps' grid; where that is dark, in the smallest square around it, of nine pixels at
/// most, that is not. `bare`: the map of zero power.
std::optional<RetinaSight> sight_at(const std::vector<SeenPass>& passes, const SliceMap& bare, const Eye& eye,
                                    int column, int row);

}  // namespace focalstage
