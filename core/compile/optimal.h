#pragma once

#include <array>
#include <cstddef>
#include <stop_token>
#include <vector>

#include "core/compile/frame_run.h"
#include "core/compile/pixel_looks.h"
#include "core/compile/stack_plan.h"
#include "core/compile/stack_solver.h"

namespace focalstage {

/// What the assignment `optimal` changes in one eye's linear images.
struct OptimalChange {
  StackPlan plan;
  std::array<StackField, 3> change;  ///< per channel [tile][slice]: linear light to be added
  OptimalMeasure measure;

  /// The 64 changes of a tile of the image of the project's slice `slice`; null where it has none.
  const float* of(std::size_t tile, std::size_t slice, std::size_t channel) const;
};

/// Solves the focal stack of one eye where linear filtering is wrong. `all` are the objects without any back left out.
/// Unfinished after a stop request.
OptimalChange optimal_change(const FrameRun& run, Side side, const PixelLooks& looks, const EyeView& all,
                             std::stop_token stop);

/// Adds the changes of a tile to its light.
void add_change(const OptimalChange& change, std::size_t tile, std::size_t slice, int channels, TileLight& light);

}  // namespace focalstage
