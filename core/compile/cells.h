#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/compile/tile.h"
#include "core/compile/view_triangles.h"

namespace focalstage {

/// Vergence of an image as a function of the inverse depth r from the pupil: gain / (1/r - lens_to_pupil) + offset_d.
struct VergenceRule {
  float gain = 1.0f;      ///< placed and offset 1; fixed and slice 0
  float offset_d = 0.0f;  ///< fixed and offset
  int slice = -1;         ///< pinned to a slice, whatever the vergence
};

/// What can be met in a cell: the range of vergences its triangles want, and the slices some are pinned to.
struct CellContent {
  float min_vergence_d;
  float max_vergence_d;
  std::uint64_t pinned_slices;
  bool depth_decides;  ///< some triangle is not pinned

  void add(const CellContent& other) {
    min_vergence_d = std::min(min_vergence_d, other.min_vergence_d);
    max_vergence_d = std::max(max_vergence_d, other.max_vergence_d);
    pinned_slices |= other.pinned_slices;
    depth_decides = depth_decides || other.depth_decides;
  }
};

inline constexpr CellContent nothing_wanted{std::numeric_limits<float>::infinity(),
                                            -std::numeric_limits<float>::infinity(), 0, false};

/// A regular grid over a rectangle of the tangent plane. Looks beyond the rectangle count to the cells at its edge.
struct CellGrid {
  Box bounds{};
  int columns = 0;
  int rows = 0;
  float per_x = 0.0f;  ///< cells per tangent unit
  float per_y = 0.0f;
};

// Internal linkage on purpose: the kernel is compiled for two instruction sets, and each must keep its own copy.
static inline int clamped_cell(float cell, int count) {
  if (!(cell > 0.0f)) return 0;
  return cell >= static_cast<float>(count) ? count - 1 : static_cast<int>(cell);
}
static inline int column_of(const CellGrid& grid, float x) {
  return clamped_cell((x - grid.bounds.min_x) * grid.per_x, grid.columns);
}
static inline int row_of(const CellGrid& grid, float y) {
  return clamped_cell((y - grid.bounds.min_y) * grid.per_y, grid.rows);
}

/// The cells that a triangle's box touches.
struct CellSpan {
  int first_column, last_column, first_row, last_row;

  int cells() const { return (last_column - first_column + 1) * (last_row - first_row + 1); }
};

/// Bands of rows are filled independently; their number is fixed, so that the order never depends on the machine.
inline constexpr int cell_bands = 16;

/// The triangles of a view, sorted into the cells that their boxes touch.
struct Cells {
  CellGrid grid;
  std::vector<std::uint32_t> begin;  ///< [rows * columns + 1] into `items`
  std::vector<std::uint32_t> items;  ///< indices of triangles, ascending within a cell
  std::vector<CellContent> content;  ///< per cell; only where rules were given

  // Memory to work in: of each triangle its span and what it wants as a whole; of each run the triangles of each band.
  std::vector<CellSpan> spans;
  std::vector<CellContent> wants;
  std::vector<std::array<std::vector<std::uint32_t>, cell_bands>> of_band;
};

/// Sorts `view` into `columns` x `rows` cells. `rules` (one per drawable, may be empty) adds what each cell can want.
/// Keeps the memory that `cells` already has.
void sort_into_cells(Cells& cells, const ViewTriangles& view, const Box& bounds, int columns, int rows,
                     const std::vector<VergenceRule>& rules, double lens_to_pupil_m);

}  // namespace focalstage
