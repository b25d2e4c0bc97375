#include "core/compile/cells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace focalstage {
namespace {

constexpr int bands = 16;  ///< of rows, filled independently; fixed, so that the order never depends on the machine
constexpr float infinity = std::numeric_limits<float>::infinity();

/// The cells that a triangle's box touches.
struct Span {
  int first_column, last_column, first_row, last_row;

  int cells() const { return (last_column - first_column + 1) * (last_row - first_row + 1); }
};

Span span_of(const CellGrid& grid, const Box& box) {
  return {column_of(grid, box.min_x), column_of(grid, box.max_x), row_of(grid, box.min_y), row_of(grid, box.max_y)};
}

struct Range {
  double low, high;
};

/// Range of a triangle's inverse depth over a rectangle, within its own range.
Range inverse_depth_over(const ViewTriangle& triangle, const TriangleBounds& bounds, const Box& box) {
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

/// A triangle in the cells: where, and what it wants as a whole.
struct Entry {
  Span span;
  CellContent content;
};

constexpr int coarse_cells = 4;  ///< a triangle in more cells is bounded in each of them apart

/// The cells of some rows, with offsets from the band's own start.
struct Band {
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> items;
};

template <class Visit>
void each_triangle(const ViewTriangles& view, const Visit& visit) {
  for (const ViewTriangles::Run& run : view.runs) {
    for (std::uint32_t i = run.first; i < run.first + run.count; ++i) visit(i);
  }
}

Band fill_band(const CellGrid& grid, const ViewTriangles& view, const std::vector<Entry>& entries, int first_row,
               int end_row) {
  Band band;
  const int columns = grid.columns;
  band.begin.assign(static_cast<std::size_t>((end_row - first_row) * columns) + 1, 0);
  const auto each_cell = [&](const auto& visit) {
    each_triangle(view, [&](std::uint32_t i) {
      const Span& span = entries[i].span;
      for (int row = std::max(span.first_row, first_row); row <= std::min(span.last_row, end_row - 1); ++row) {
        for (int column = span.first_column; column <= span.last_column; ++column) {
          visit(static_cast<std::size_t>((row - first_row) * columns + column), i);
        }
      }
    });
  };
  each_cell([&](std::size_t cell, std::uint32_t) { ++band.begin[cell + 1]; });
  for (std::size_t i = 1; i < band.begin.size(); ++i) band.begin[i] += band.begin[i - 1];
  band.items.resize(band.begin.back());
  std::vector<std::uint32_t> next(band.begin.begin(), band.begin.end() - 1);
  each_cell([&](std::size_t cell, std::uint32_t i) { band.items[next[cell]++] = i; });
  return band;
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

void measure_content(Cells& cells, const ViewTriangles& view, const std::vector<Entry>& entries, const Wants& wants) {
  const CellGrid& grid = cells.grid;
  cells.content.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows), nothing_wanted);
  tbb::parallel_for(0, grid.rows, [&](int row) {
    for (int column = 0; column < grid.columns; ++column) {
      const auto cell = static_cast<std::size_t>(row * grid.columns + column);
      for (std::uint32_t i = cells.begin[cell]; i < cells.begin[cell + 1]; ++i) {
        const std::uint32_t at = cells.items[i];
        const Entry& entry = entries[at];
        if (entry.span.cells() <= coarse_cells) {
          cells.content[cell].add(entry.content);
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
  const Wants wants(rules, lens_to_pupil_m);
  std::vector<Entry> entries(view.bounds.size());
  tbb::parallel_for(std::size_t{0}, view.runs.size(), [&](std::size_t run) {
    for (std::uint32_t i = view.runs[run].first; i < view.runs[run].first + view.runs[run].count; ++i) {
      const TriangleBounds& of = view.bounds[i];
      entries[i].span = span_of(cells.grid, of.box);
      if (!rules.empty()) entries[i].content = wants.of(view.triangles[i], {of.min_inverse_m, of.max_inverse_m});
    }
  });
  std::vector<Band> filled(bands);
  tbb::parallel_for(0, bands, [&](int i) {
    filled[static_cast<std::size_t>(i)] =
        fill_band(cells.grid, view, entries, rows * i / bands, rows * (i + 1) / bands);
  });
  join(cells, filled);
  cells.content.clear();
  if (!rules.empty()) measure_content(cells, view, entries, wants);
}

}  // namespace focalstage
