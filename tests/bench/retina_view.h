#pragma once

#include <string>

#include "core/base/result.h"
#include "tests/bench/scenes.h"

namespace focalstage::bench {

/// Medians of one eye's view of a compiled scene.
struct RetinaTimes {
  double first_ms = 0.0;  ///< nothing known beforehand
  double head_ms = 0.0;   ///< the head moves
  double focus_ms = 0.0;  ///< the focus moves, the images are new
};

/// On one thread, 6 slices and a light image.
Result<RetinaTimes> time_retina(const BenchScene& scene, int width_px, int height_px, int rounds);

}  // namespace focalstage::bench
