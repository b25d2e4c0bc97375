#include "core/compile/cuts.h"

#include <cmath>

namespace focalstage {
namespace {

/// One look of a tile.
struct Look {
  float x, y;  ///< from the tile's origin
  double origin_x, origin_y;

  double in_plane_x() const { return origin_x + static_cast<double>(x); }
  double in_plane_y() const { return origin_y + static_cast<double>(y); }
};

/// What the kernel makes of this look and a triangle: 1 / depth, or 0 where it passes by.
float met(const ViewTriangle& triangle, const Look& look, float highest) {
  float value[4];
  for (int i = 0; i < 4; ++i) {
    const auto rest = static_cast<float>(triangle.a[i] * look.origin_x + triangle.b[i] * look.origin_y + triangle.c[i]);
    value[i] = static_cast<float>(triangle.a[i]) * look.x + static_cast<float>(triangle.b[i]) * look.y + rest;
  }
  const bool inside = value[0] >= 0.0f && value[1] >= 0.0f && value[2] >= 0.0f;
  return inside && value[3] > 0.0f && value[3] <= highest ? value[3] : 0.0f;
}

/// The nearest triangle along the look that is there where it is met.
void find_solid(const KernelView& view, const Look& look, const IsCut& is_cut, float& inverse_m,
                std::int32_t& triangle) {
  inverse_m = 0.0f;
  triangle = -1;
  const float highest = 1.0f / view.nearest_m;
  const auto x = static_cast<float>(look.in_plane_x());
  const auto y = static_cast<float>(look.in_plane_y());
  const float slack = 1e-6f * (1.0f + std::abs(x) + std::abs(y));  // for the rounding of triangles' boxes
  const CellGrid& grid = view.grid;
  for (int row = row_of(grid, y - slack); row <= row_of(grid, y + slack); ++row) {
    for (int column = column_of(grid, x - slack); column <= column_of(grid, x + slack); ++column) {
      const std::uint32_t* const begin = view.begin + (row * grid.columns + column);
      for (std::uint32_t i = begin[0]; i < begin[1]; ++i) {
        const std::uint32_t index = view.items[i];
        const float found = met(view.triangles[index], look, highest);
        if (!(found > inverse_m) || is_cut(index, look.in_plane_x(), look.in_plane_y())) continue;
        inverse_m = found;
        triangle = static_cast<std::int32_t>(index);
      }
    }
  }
}

}  // namespace

void pass_cuts(const KernelView& view, const TileLooks& looks, double origin_x, double origin_y, const IsCut& is_cut,
               TileNearest& nearest) {
  for (int i = 0; i < tile_samples; ++i) {
    if (nearest.triangle[i] < 0) continue;
    const Look look{looks.x[i], looks.y[i], origin_x, origin_y};
    const auto first = static_cast<std::uint32_t>(nearest.triangle[i]);
    if (!is_cut(first, look.in_plane_x(), look.in_plane_y())) continue;
    find_solid(view, look, is_cut, nearest.inverse_m[i], nearest.triangle[i]);
  }
}

void pass_cuts(const EyeView& view, const TileLooks& looks, double origin_x, double origin_y, TileNearest& nearest) {
  if (!view.cuts) return;
  const auto is_cut = [&](std::uint32_t index, double x, double y) {
    const ViewTriangle& triangle = view.view.triangles[index];
    return view.shaders[triangle.drawable].is_cut(triangle, x, y);
  };
  pass_cuts(kernel_view(view.view, view.cells), looks, origin_x, origin_y, is_cut, nearest);
}

}  // namespace focalstage
