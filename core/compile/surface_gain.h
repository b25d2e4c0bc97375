#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/sides.h"
#include "core/compile/frame.h"
#include "core/compile/surface_hits.h"
#include "core/compile/view_triangles.h"

namespace focalstage {

/// What wanted light is multiplied by in the pixels of one tile; 0 where they light nothing.
struct alignas(32) TileGain {
  float content[3][tile_samples];  ///< per channel: 1 / what comes back of a pixel's light, scaled
  float light[tile_samples];       ///< of surface light
};

/// Radiometric compensation of one projector (docs/colour.md): tiles in rows, as a frame's images have them.
struct SurfaceGains {
  std::vector<TileGain> tiles;
  PerEye<float>
      leak;  ///< taken off for a whole weight: what leaks in all of an eye's exposures, against 1 - black level
};

/// None where the settings ask for none.
std::optional<SurfaceGains> surface_gains(const CompileSettings& settings, const ProjectorRays& rays,
                                          const ProjectorHits& met, const std::vector<ViewDrawable>& surfaces);

/// How many exposures of a period an eye gets.
int exposures_of(const CompileSettings& settings, Side side);

}  // namespace focalstage
