#include "core/compile/cells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace focalstage {
namespace {

constexpr int bands = 16;  ///< of rows, filled independently; fixed, so that the order never depends on the machine

/// The cells that a triangle's box touches.
struct Span {
  int first_column, last_column, first_row, last_row;
};

Span span_of(const CellGrid& grid, const Box& box) {
  return {column_of(grid, box.min_x), column_of(grid, box.max_x), row_of(grid, box.min_y), row_of(grid, box.max_y)};
}

struct Range {
  double low, high;
};

/// Range of an affine function over a rectangle.
Range range_over(const Affine& f, const Box& box) {
  const double middle =
      f.at(0.5 * (static_cast<double>(box.min_x) + box.max_x), 0.5 * (static_cast<double>(box.min_y) + box.max_y));
  const double reach = 0.5 * (std::abs(f.x) * (static_cast<double>(box.max_x) - box.min_x) +
                              std::abs(f.y) * (static_cast<double>(box.max_y) - box.min_y));
  return {middle - reach, middle + reach};
}

/// The part of `box` in a cell; cells at the edge of the grid reach to infinity.
Box part_in_cell(const CellGrid& grid, const Box& box, int column, int row) {
  Box part = box;
  const auto edge = [](float origin, int cell, float per) { return origin + static_cast<float>(cell) / per; };
  if (column > 0) part.min_x = std::max(part.min_x, edge(grid.bounds.min_x, column, grid.per_x));
  if (column + 1 < grid.columns) part.max_x = std::min(part.max_x, edge(grid.bounds.min_x, column + 1, grid.per_x));
  if (row > 0) part.min_y = std::max(part.min_y, edge(grid.bounds.min_y, row, grid.per_y));
  if (row + 1 < grid.rows) part.max_y = std::min(part.max_y, edge(grid.bounds.min_y, row + 1, grid.per_y));
  return part;
}

void take_in(CellContent& content, const VergenceRule& rule, Range inverse_depth, double nearest_m,
             double lens_to_pupil_m) {
  if (rule.slice >= 0) {
    content.pinned_slices |= std::uint64_t{1} << rule.slice;
    return;
  }
  constexpr double slack_d = 1e-3;  // far above the rounding of the samples' own single-precision vergences
  const auto vergence_d = [&](double r) {
    const double within = std::clamp(r, 1e-9, 1.0 / nearest_m);
    return rule.gain * within / (1.0 - lens_to_pupil_m * within) + rule.offset_d;
  };
  content.depth_decides = true;
  content.min_vergence_d =
      std::min(content.min_vergence_d, static_cast<float>(vergence_d(inverse_depth.low) - slack_d));
  content.max_vergence_d =
      std::max(content.max_vergence_d, static_cast<float>(vergence_d(inverse_depth.high) + slack_d));
}

/// The cells of some rows, with offsets from the band's own start.
struct Band {
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> items;
};

Band fill_band(const CellGrid& grid, const std::vector<Span>& spans, int first_row, int end_row) {
  Band band;
  const auto columns = static_cast<std::size_t>(grid.columns);
  band.begin.assign(static_cast<std::size_t>(end_row - first_row) * columns + 1, 0);
  const auto each_cell = [&](auto&& visit) {
    for (std::uint32_t i = 0; i < spans.size(); ++i) {
      const Span& span = spans[i];
      for (int row = std::max(span.first_row, first_row); row <= std::min(span.last_row, end_row - 1); ++row) {
        for (int column = span.first_column; column <= span.last_column; ++column) {
          visit(static_cast<std::size_t>(row - first_row) * columns + static_cast<std::size_t>(column), i);
        }
      }
    }
  };
  each_cell([&](std::size_t cell, std::uint32_t) { ++band.begin[cell + 1]; });
  for (std::size_t i = 1; i < band.begin.size(); ++i) band.begin[i] += band.begin[i - 1];
  band.items.resize(band.begin.back());
  std::vector<std::uint32_t> next(band.begin.begin(), band.begin.end() - 1);
  each_cell([&](std::size_t cell, std::uint32_t i) { band.items[next[cell]++] = i; });
  return band;
}

void join(Cells& cells, const std::vector<Band>& filled) {
  cells.begin.push_back(0);
  for (const Band& band : filled) {
    const auto offset = static_cast<std::uint32_t>(cells.items.size());
    for (std::size_t i = 1; i < band.begin.size(); ++i) cells.begin.push_back(offset + band.begin[i]);
    cells.items.insert(cells.items.end(), band.items.begin(), band.items.end());
  }
}

void measure_content(Cells& cells, const ViewTriangles& view, const std::vector<VergenceRule>& rules,
                     double lens_to_pupil_m) {
  const CellGrid& grid = cells.grid;
  constexpr float infinity = std::numeric_limits<float>::infinity();
  cells.content.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
                       {infinity, -infinity, 0, false});
  tbb::parallel_for(0, grid.rows, [&](int row) {
    for (int column = 0; column < grid.columns; ++column) {
      const auto cell =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(column);
      for (std::uint32_t i = cells.begin[cell]; i < cells.begin[cell + 1]; ++i) {
        const ViewTriangle& triangle = view.triangles[cells.items[i]];
        const Range depth = range_over(triangle.inverse_depth, part_in_cell(grid, triangle.box, column, row));
        take_in(cells.content[cell], rules[triangle.drawable], depth, view.nearest_m, lens_to_pupil_m);
      }
    }
  });
}

}  // namespace

Cells sort_into_cells(const ViewTriangles& view, const Box& bounds, int columns, int rows,
                      const std::vector<VergenceRule>& rules, double lens_to_pupil_m) {
  Cells cells;
  cells.grid = {bounds, columns, rows, static_cast<float>(columns) / std::max(bounds.max_x - bounds.min_x, 1e-12f),
                static_cast<float>(rows) / std::max(bounds.max_y - bounds.min_y, 1e-12f)};

  std::vector<Span> spans(view.triangles.size());
  tbb::parallel_for(std::size_t{0}, spans.size(),
                    [&](std::size_t i) { spans[i] = span_of(cells.grid, view.triangles[i].box); });
  std::vector<Band> filled(bands);
  tbb::parallel_for(0, bands, [&](int i) {
    filled[static_cast<std::size_t>(i)] = fill_band(cells.grid, spans, rows * i / bands, rows * (i + 1) / bands);
  });
  join(cells, filled);
  if (!rules.empty()) measure_content(cells, view, rules, lens_to_pupil_m);
  return cells;
}

}  // namespace focalstage
