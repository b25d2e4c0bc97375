#include "core/compile/wanted_depth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include <glm/matrix.hpp>

#include "core/compile/cuts.h"
#include "core/optics/vergence.h"

namespace focalstage {
namespace {

std::size_t place_of(const TileGrid& grid, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width_px) + static_cast<std::size_t>(x);
}

/// What the straight looks of one tile meet.
bool meet(const EyeView& view, const LookTile& tile, const Kernel& kernel, TileNearest& nearest) {
  double x[tile_samples];
  double y[tile_samples];
  std::copy_n(tile.x, tile_samples, x);
  std::copy_n(tile.y, tile_samples, y);
  const LocalLooks local = local_looks(x, y, kernel);
  if (!local.any) return false;
  kernel.cover(kernel_view(view.view, view.cells), local.looks, local.origin_x, local.origin_y, nearest);
  pass_cuts(view, local.looks, local.origin_x, local.origin_y, nearest);
  return true;
}

}  // namespace

WantedVergence wanted_vergence(const VergenceRule& rule, const std::vector<SliceSetup>& slices, double surface_m,
                               double inverse_m, double lens_to_pupil_m) {
  if (rule.slice >= 0) {
    const double power_d = slices[static_cast<std::size_t>(rule.slice)].power_d;
    return {0.0, vergence_at_pupil_d(image_vergence_d(surface_m, power_d), lens_to_pupil_m)};
  }
  if (rule.gain == 0.0f) return {0.0, vergence_at_pupil_d(rule.offset_d, lens_to_pupil_m)};
  if (rule.offset_d == 0.0f) return {};
  // From r at the pupil to r / (1 - d_e r) at the lens, the offset added, and back.
  const double bent = rule.offset_d * lens_to_pupil_m;
  const double whole = 1.0 + bent - bent * lens_to_pupil_m * inverse_m;
  return {(1.0 - bent) / whole, rule.offset_d / whole};
}

WantedDepth wanted_depth(const EyeView& view, const PixelLooks& looks, const std::vector<SliceSetup>& slices,
                         const Kernel& kernel) {
  const TileGrid& grid = looks.grid;
  WantedDepth out;
  const auto pixels = static_cast<std::size_t>(grid.width_px) * static_cast<std::size_t>(grid.height_px);
  out.vergence_d.assign(pixels, WantedDepth::none);
  out.power_d.assign(pixels, WantedDepth::none);
  tbb::parallel_for(0, grid.rows(), [&](int row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const LookTile& tile = looks.tiles[static_cast<std::size_t>(row * grid.columns() + column)];
      TileNearest nearest;
      if (!meet(view, tile, kernel, nearest)) continue;
      for (int i = 0; i < tile_samples; ++i) {
        const int x = column * tile_side + i % tile_side;
        const int y = row * tile_side + i / tile_side;
        if (nearest.triangle[i] < 0 || x >= grid.width_px || y >= grid.height_px) continue;
        const ViewTriangle& triangle = view.view.triangles[static_cast<std::size_t>(nearest.triangle[i])];
        const double inverse_m = nearest.inverse_m[i];
        const WantedVergence wanted =
            wanted_vergence(view.rules[triangle.drawable], slices, tile.surface_m[i], inverse_m, view.lens_to_pupil_m);
        const double at_pupil_d = wanted.at(inverse_m);
        const double at_lens_d = at_pupil_d / (1.0 - at_pupil_d * view.lens_to_pupil_m);
        out.vergence_d[place_of(grid, x, y)] = static_cast<float>(at_pupil_d);
        out.power_d[place_of(grid, x, y)] = static_cast<float>(1.0 / tile.surface_m[i] - at_lens_d);
      }
    }
  });
  return out;
}

std::vector<std::uint8_t> depth_edges(const WantedDepth& wanted, const PixelLooks& looks, double pupil_m) {
  const TileGrid& grid = looks.grid;
  std::vector<std::uint8_t> marks(wanted.vergence_d.size(), 0);
  const auto jumps = [&](std::size_t a, std::size_t b, double limit_d) {
    return std::abs(wanted.vergence_d[a] - wanted.vergence_d[b]) > limit_d;  // a NaN is no jump
  };
  tbb::parallel_for(0, grid.height_px, [&](int y) {
    for (int x = 0; x < grid.width_px; ++x) {
      const std::size_t here = place_of(grid, x, y);
      if (!(wanted.vergence_d[here] == wanted.vergence_d[here])) continue;
      const LookTile& tile = looks.tiles[static_cast<std::size_t>(y / tile_side * grid.columns() + x / tile_side)];
      if (!tile.usable) continue;
      const double pitch = std::sqrt(std::abs(glm::determinant(tile.look_per_pixel)));
      for (const int off : {1, 2, 4}) {
        const double limit_d = off * pitch / pupil_m;
        const bool edge = (x >= off && jumps(here, place_of(grid, x - off, y), limit_d)) ||
                          (x + off < grid.width_px && jumps(here, place_of(grid, x + off, y), limit_d)) ||
                          (y >= off && jumps(here, place_of(grid, x, y - off), limit_d)) ||
                          (y + off < grid.height_px && jumps(here, place_of(grid, x, y + off), limit_d));
        if (!edge) continue;
        marks[here] = 1;
        break;
      }
    }
  });
  return marks;
}

std::vector<std::uint8_t> widened(const std::vector<std::uint8_t>& marks, int width_px, int height_px, int reach) {
  // A mark counts down along each line, first one way and then the other.
  std::vector<std::uint8_t> out = marks;
  const auto spread = [&](std::size_t first, std::size_t step, int count) {
    int left = 0;
    std::vector<std::uint8_t> from(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) from[static_cast<std::size_t>(i)] = out[first + static_cast<std::size_t>(i) * step];
    for (int i = 0; i < count; ++i) {
      left = from[static_cast<std::size_t>(i)] != 0 ? reach + 1 : left - 1;
      if (left > 0) out[first + static_cast<std::size_t>(i) * step] = 1;
    }
    left = 0;
    for (int i = count - 1; i >= 0; --i) {
      left = from[static_cast<std::size_t>(i)] != 0 ? reach + 1 : left - 1;
      if (left > 0) out[first + static_cast<std::size_t>(i) * step] = 1;
    }
  };
  const auto width = static_cast<std::size_t>(width_px);
  tbb::parallel_for(0, height_px, [&](int y) { spread(static_cast<std::size_t>(y) * width, 1, width_px); });
  tbb::parallel_for(0, width_px, [&](int x) { spread(static_cast<std::size_t>(x), width, height_px); });
  return out;
}

}  // namespace focalstage
