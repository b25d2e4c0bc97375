#pragma once

#include <array>
#include <vector>

#include "core/retina/blur.h"
#include "core/retina/exposure_lights.h"
#include "core/retina/focus.h"
#include "core/retina/lens_rim.h"
#include "core/retina/passes.h"
#include "core/retina/slice_map.h"

namespace focalstage {

/// What stands between maps and picture: everything a row needs.
struct PaintWork {
  const std::vector<Pass>& passes;
  const std::vector<const SliceMap*>& maps;         ///< one per pass
  const std::vector<const ExposureLight*>& lights;  ///< one per exposure; null: not seen
  const std::array<float, 256>& light_of_code;
  const RetinaInput& input;
  const Focus& focus;
  const LensRim& rim;
};

/// Sorts the light of one row of all passes into the layers of its blur.
void paint_row(const PaintWork& work, int row, BlurLayers& layers);

}  // namespace focalstage
