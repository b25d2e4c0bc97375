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
  float leak[tile_samples];        ///< what SurfaceGains::leak is multiplied by: 1 for a projector alone
};

/// Radiometric compensation of one projector (docs/colour.md): tiles in rows, as a frame's images have them.
struct SurfaceGains {
  std::vector<TileGain> tiles;
  PerEye<float>
      leak;  ///< taken off for a whole weight: what leaks in all of an eye's exposures, against 1 - black level
  bool counts = true;  ///< whether what pixels are asked for beyond what they can is worth counting: with compensation
};

/// None where the settings ask for none and the projector is alone. With others, its share of the light is in them.
std::optional<SurfaceGains> surface_gains(const CompileSettings& settings, const ProjectorRays& rays,
                                          const ProjectorHits& met, const std::vector<ViewDrawable>& surfaces,
                                          const Kernel& kernel);

/// Whether black is made up for: some projector leaks, and codes are to say so.
bool makes_up_for_black(const CompileSettings& settings);

/// How many exposures of a period an eye gets.
int exposures_of(const CompileSettings& settings, Side side);

}  // namespace focalstage
