#include "core/compile/cells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace focalstage {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

CellSpan span_of(const CellGrid& grid, const Box& box) {
  return {column_of(grid, box.min_x), column_of(grid, box.max_x), row_of(grid, box.min_y), row_of(grid, box.max_y)};
}

/// Band i has the rows from first_row_of(i) to before first_row_of(i + 1).
int first_row_of(int band, int rows) { return rows * band / cell_bands; }
int band_of(int row, int rows) { return ((row + 1) * cell_bands - 1) / rows; }

struct Range {
  double low, high;
};

/// Range of a triangle's inverse depth over a rectangle, within its own range.
Range inverse_depth_over(const ViewTriangle& triangle, const ViewBounds& bounds, const Box& box) {
  const double centre_x = 0.5 * (static_cast<double>(box.min_x) + box.max_x);
  const double centre_y = 0.5 * (static_cast<double>(box.min_y) + box.max_y);
  const double reach = 0.5 * (std::abs(triangle.a[3]) * (static_cast<double>(box.max_x) - box.min_x) +
                              std::abs(triangle.b[3]) * (static_cast<double>(box.max_y) - box.min_y));
  const double middle = triangle.inverse_depth(centre_x, centre_y);
  return {std::max<double>(middle - reach, bounds.min_inverse_m),
          std::min<double>(middle + reach, bounds.max_inverse_m)};
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

/// Adds what a triangle wants where its inverse depth lies in a range.
class Wants {
 public:
  Wants(const std::vector<VergenceRule>& rules, double lens_to_pupil_m)
      : rules_(rules), lens_to_pupil_m_(lens_to_pupil_m) {}

  CellContent of(const ViewTriangle& triangle, Range inverse_m) const {
    const VergenceRule& rule = rules_[triangle.drawable];
    if (rule.slice >= 0) return {infinity, -infinity, std::uint64_t{1} << rule.slice, false};
    constexpr double slack_d = 1e-3;  // far above the rounding of the samples' own single-precision vergences
    const auto vergence_d = [&](double r) { return rule.gain * r / (1.0 - lens_to_pupil_m_ * r) + rule.offset_d; };
    return {static_cast<float>(vergence_d(inverse_m.low) - slack_d),
            static_cast<float>(vergence_d(inverse_m.high) + slack_d), 0, true};
  }

 private:
  const std::vector<VergenceRule>& rules_;
  double lens_to_pupil_m_;
};

constexpr int coarse_cells = 4;  ///< a triangle in more cells is bounded in each of them apart

/// The cells of some rows, with offsets from the band's own start.
struct Band {
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> items;
};

Band fill_band(const Cells& cells, int which) {
  const int columns = cells.grid.columns;
  const int first_row = first_row_of(which, cells.grid.rows);
  const int end_row = first_row_of(which + 1, cells.grid.rows);
  Band band;
  band.begin.assign(static_cast<std::size_t>((end_row - first_row) * columns) + 1, 0);
  const auto each_cell = [&](const auto& visit) {
    for (const auto& run : cells.of_band) {
      for (const std::uint32_t i : run[static_cast<std::size_t>(which)]) {
        const CellSpan& span = cells.spans[i];
        for (int row = std::max(span.first_row, first_row); row <= std::min(span.last_row, end_row - 1); ++row) {
          for (int column = span.first_column; column <= span.last_column; ++column) {
            visit(static_cast<std::size_t>((row - first_row) * columns + column), i);
          }
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

/// Which cells the triangles of each run touch, and in which bands those are.
void place_runs(Cells& cells, const ViewTriangles& view) {
  cells.spans.resize(std::max(cells.spans.size(), view.bounds.size()));
  cells.of_band.resize(view.runs.size());
  tbb::parallel_for(std::size_t{0}, view.runs.size(), [&](std::size_t run) {
    auto& of_band = cells.of_band[run];
    for (auto& triangles : of_band) triangles.clear();
    for (std::uint32_t i = view.runs[run].first; i < view.runs[run].first + view.runs[run].count; ++i) {
      const CellSpan span = span_of(cells.grid, view.bounds[i].box);
      const int last = band_of(span.last_row, cells.grid.rows);
      for (int band = band_of(span.first_row, cells.grid.rows); band <= last; ++band) {
        of_band[static_cast<std::size_t>(band)].push_back(i);
      }
      cells.spans[i] = span;
    }
  });
}

void join(Cells& cells, const std::vector<Band>& filled) {
  cells.begin.assign(1, 0);
  cells.items.clear();
  for (const Band& band : filled) {
    const auto offset = static_cast<std::uint32_t>(cells.items.size());
    for (std::size_t i = 1; i < band.begin.size(); ++i) cells.begin.push_back(offset + band.begin[i]);
    cells.items.insert(cells.items.end(), band.items.begin(), band.items.end());
  }
}

/// What the triangles of each run want as a whole.
void ask_triangles(Cells& cells, const ViewTriangles& view, const Wants& wants) {
  cells.wants.resize(std::max(cells.wants.size(), view.bounds.size()));
  tbb::parallel_for(std::size_t{0}, view.runs.size(), [&](std::size_t run) {
    for (std::uint32_t i = view.runs[run].first; i < view.runs[run].first + view.runs[run].count; ++i) {
      cells.wants[i] = wants.of(view.triangles[i], {view.bounds[i].min_inverse_m, view.bounds[i].max_inverse_m});
    }
  });
}

void measure_content(Cells& cells, const ViewTriangles& view, const Wants& wants) {
  ask_triangles(cells, view, wants);
  const CellGrid& grid = cells.grid;
  cells.content.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows), nothing_wanted);
  tbb::parallel_for(0, grid.rows, [&](int row) {
    for (int column = 0; column < grid.columns; ++column) {
      const auto cell = static_cast<std::size_t>(row * grid.columns + column);
      for (std::uint32_t i = cells.begin[cell]; i < cells.begin[cell + 1]; ++i) {
        const std::uint32_t at = cells.items[i];
        if (cells.spans[at].cells() <= coarse_cells) {
          cells.content[cell].add(cells.wants[at]);
          continue;
        }
        const Box part = part_in_cell(grid, view.bounds[at].box, column, row);
        const Range depth = inverse_depth_over(view.triangles[at], view.bounds[at], part);
        cells.content[cell].add(wants.of(view.triangles[at], depth));
      }
    }
  });
}

}  // namespace

void sort_into_cells(Cells& cells, const ViewTriangles& view, const Box& bounds, int columns, int rows,
                     const std::vector<VergenceRule>& rules, double lens_to_pupil_m) {
  cells.grid = {bounds, columns, rows, static_cast<float>(columns) / std::max(bounds.max_x - bounds.min_x, 1e-12f),
                static_cast<float>(rows) / std::max(bounds.max_y - bounds.min_y, 1e-12f)};
  place_runs(cells, view);
  std::vector<Band> filled(cell_bands);
  tbb::parallel_for(0, cell_bands, [&](int i) { filled[static_cast<std::size_t>(i)] = fill_band(cells, i); });
  join(cells, filled);
  cells.content.clear();
  if (!rules.empty()) measure_content(cells, view, Wants(rules, lens_to_pupil_m));
}

}  // namespace focalstage
