#pragma once

#include <cstdint>

#include "core/compile/cells.h"
#include "core/compile/tile.h"
#include "core/compile/view_triangles.h"

namespace focalstage {

// The innermost loops, over plain arrays, as many samples at a time as a register holds. The same source is compiled
// for x86-64-v2 and for AVX2 (kernel_portable.cpp, kernel_avx2.cpp); both do the same operations in the same order, so
// their results are the same bits. All positions are relative to a tile's origin in the tangent plane: there single
// precision is a millionth of a pixel.

/// What the projector's samples of one tile meet, as one eye sees it. NaN positions where it sees nothing.
struct alignas(32) TileHits {
  float x[tile_samples];  ///< straight look, from the tile's origin
  float y[tile_samples];
  float surface_m[tile_samples];  ///< the distance that stretches the look: d_p, or d_c for planar breathing
  float inverse_m[tile_samples];  ///< 1 / distance of the point from the pupil, along the gaze
  float slope[tile_samples];      ///< change of inverse_m on the surface's plane per unit of (stretch - 1)
};

/// The triangles of a view in their cells, as plain pointers.
struct KernelView {
  const ViewTriangle* triangles;
  const ViewBounds* bounds;
  CellGrid grid;
  const std::uint32_t* begin;
  const std::uint32_t* items;
  float nearest_m;
};

/// Looks of one slice, from the tile's origin, and their bounds.
struct alignas(32) TileLooks {
  float x[tile_samples];
  float y[tile_samples];
  float row_min_x[tile_side];  ///< bounds of each row, from the tile's origin
  float row_min_y[tile_side];
  float row_max_x[tile_side];
  float row_max_y[tile_side];
  Box all;  ///< in the tangent plane
};

/// The nearest triangle along each look.
struct alignas(32) TileNearest {
  float inverse_m[tile_samples];        ///< 0 where nothing is met
  std::int32_t triangle[tile_samples];  ///< index in the view; -1 where nothing is met
};

/// How the wanted power of a slice becomes its weight; see SliceRule.
struct SliceBand {
  float power_d = 0.0f;
  float per_d_below = 0.0f;  ///< linear: 1 / distance to the lower neighbour, 0 without one
  float per_d_above = 0.0f;
  float from_d = 0.0f;  ///< nearest: has all of (from, to]
  float to_d = 0.0f;
  bool nearest = false;
};

struct alignas(32) TileWants {
  float gain[tile_samples];  ///< the vergence rule of the triangle met
  float offset_d[tile_samples];
};

struct alignas(32) TileWeights {
  float wanted_d[tile_samples];  ///< v*
  float weight[tile_samples];
};

/// What the lit samples of a tile have in common.
struct TileLit {
  int count = 0;
  std::int32_t lowest_triangle = 0;  ///< of the indices met
  std::int32_t highest_triangle = 0;
  float lowest_d = 0.0f;  ///< of the powers wanted
  float highest_d = 0.0f;
};

/// A checker on one triangle: square coordinates as affine functions of the look over a common one; see ViewTriangle.
struct CheckerPlanes {
  double u[3], v[3], common[3];  ///< per x, per y, constant
};

struct Kernel {
  /// Looks through a lens whose power times lens_to_pupil is `bend`.
  void (*place)(const TileHits& hits, double origin_x, double origin_y, float bend, float lens_to_pupil_m,
                TileLooks& out);

  /// The nearest triangle along each look; candidates come from the cells that `looks.all` touches.
  void (*cover)(const KernelView& view, const TileLooks& looks, double origin_x, double origin_y, TileNearest& out);

  /// Wanted power and weight where something is met; weight 0 elsewhere.
  void (*weigh)(const TileHits& hits, const TileNearest& nearest, const TileWants& wants, const SliceBand& band,
                float bend, float lens_to_pupil_m, TileWeights& out);

  /// Sums up the samples whose weight is above zero.
  TileLit (*lit)(const TileNearest& nearest, const TileWeights& weights);

  /// Adds weight * share * level to each sample of `light`.
  void (*add_even)(const TileWeights& weights, float share, float level, float* light);

  /// Adds weight * share * (the level of the square that the look meets): `a` where the squares' numbers sum to even.
  void (*add_checker)(const CheckerPlanes& planes, const TileLooks& looks, double origin_x, double origin_y,
                      const TileWeights& weights, float share, float a, float b, float* light);

  /// Adds sign * share * value to the 64 `sums` of a tile, row by row: sums(x, y) += sign * the sum over the rectangle
  /// of share(i, j) * from[(y + way * j) * stride + x + way * i].
  void (*spread)(const float* from, int stride, int way, const float* shares, int width, int height, float sign,
                 float* sums);
};

extern const Kernel portable_kernel;
extern const Kernel avx2_kernel;

/// The fastest that this processor runs.
const Kernel& best_kernel();

}  // namespace focalstage
