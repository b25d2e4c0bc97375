#pragma once

#include <cstdint>
#include <vector>

#include "core/compile/eye_view.h"
#include "core/compile/tile.h"

namespace focalstage {

/// Light of one tile of one image, per channel, summed over the samples of its pixels.
struct alignas(32) TileLight {
  float channel[3][tile_samples];
  float weight[tile_samples];  ///< of all that is shown, whatever its colour; only where a run keeps weights
  bool any = false;
};

/// Counts of one worker; sums and maxima, so that their order does not matter.
struct ObjectTally {
  std::uint64_t samples = 0;
  std::uint64_t beyond = 0;
  double worst_beyond_d = 0.0;
  double worst_below_d = 0.0;
  double worst_above_d = 0.0;
};

/// What the slices of a frame share.
struct SliceRun {
  const Kernel* kernel;
  const SliceRule* rule;
  int channels;
  float share;                 ///< of one sample in its pixel
  bool keeps_weights = false;  ///< sums up TileLight::weight too
};

/// Adds what slice number `slice_index` of one eye shows in one tile: looks, the nearest object along each, its weight
/// in the slice, and its colour where that is above zero.
void slice_tile(const SliceRun& run, const EyeView& view, const EyeTile& tile, const SliceSetup& slice,
                std::size_t slice_index, TileLight& light, std::vector<ObjectTally>& tallies);

}  // namespace focalstage
