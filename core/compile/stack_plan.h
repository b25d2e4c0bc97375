#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/compile/pixel_looks.h"
#include "core/compile/wanted_depth.h"

namespace focalstage {

// A *focal stack* is what an eye sees of a picture at several focuses. Here it is asked for in the projector's own
// raster as the eye sees it without a lens: a cell is where a pixel's straight look falls. A slice's pixels fall beside
// the cells, moved by the lens and spread by the blur of its distance to the focus; within a tile both are the same for
// all pixels, so that a slice's part in the stack is a small convolution of its own pixels. No light is resampled.

/// Which pixels of a slice a cell sees at one focus: a rectangle from (x, y) off the cell, and its shares.
struct StackSpan {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  std::size_t first = 0;  ///< in the tile's shares
};

struct StackTile {
  int column = 0;
  int row = 0;
  std::uint64_t asked = 0;          ///< cells near depth edges; bit i is sample i of the tile
  std::uint64_t counted = 0;        ///< cells whose error counts
  std::vector<std::uint64_t> free;  ///< per slice of the plan: pixels that may change
  std::vector<double> slice_d;      ///< per slice: its picture's vergence at the pupil
  std::vector<double> focus_d;      ///< of the stack, at the pupil
  std::vector<StackSpan> spans;     ///< [slice][focus]
  std::vector<float> shares;

  bool any_free() const;
};

struct StackPlan {
  TileGrid grid;
  double pupil_m = 0.0;
  std::vector<std::size_t> slices;    ///< the project's indices, by rising power
  int foci = 0;                       ///< at these slices and half-way between
  std::vector<std::int32_t> slot_of;  ///< per tile of the grid: index into `tiles`, or -1
  std::vector<StackTile> tiles;
  std::size_t asked_tiles = 0;
  std::size_t left_tiles = 0;  ///< near depth edges too, but more than time allows

  bool empty() const { return tiles.empty(); }
  std::size_t slice_count() const { return slices.size(); }
  std::size_t focus_count() const { return static_cast<std::size_t>(foci); }
};

/// What tiles near depth edges cost with up to five slices (with more, in proportion to the pairs of slice and focus),
/// and how much of it may be spent: that bounds time and memory of a frame. Where there is more, the tiles with the
/// most edges are solved.
struct StackBudget {
  double limit = 0.0;
  std::function<double(std::size_t tile)> cost;
};

/// Lays out what has to be solved for one eye; empty where nothing has.
StackPlan stack_plan(const WantedDepth& wanted, const PixelLooks& looks, const std::vector<SliceSetup>& slices,
                     double lens_to_pupil_m, const StackBudget& budget);

}  // namespace focalstage
