#include "core/compile/pixel_looks.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace focalstage {
namespace {

bool seen(const LookTile& tile, int i) { return tile.x[i] == tile.x[i]; }

/// The mean of a pixel's samples that the eye sees.
void set_pixel(const EyeHits& hits, std::size_t tile, std::size_t tiles, int subsamples, double lens_to_pupil_m, int i,
               LookTile& out) {
  glm::dvec2 look(0.0);
  double surface_m = 0.0;
  double stretch_m = 0.0;
  int count = 0;
  for (int s = 0; s < subsamples; ++s) {
    const EyeTile& from = hits.tiles[static_cast<std::size_t>(s) * tiles + tile];
    if (!from.any || from.hits.x[i] != from.hits.x[i]) continue;
    look += glm::dvec2(from.origin_x + from.hits.x[i], from.origin_y + from.hits.y[i]);
    surface_m += 1.0 / from.hits.inverse_m[i] - lens_to_pupil_m;
    stretch_m += from.hits.surface_m[i];
    ++count;
  }
  const bool any = count > 0;
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  out.x[i] = any ? static_cast<float>(look.x / count) : nan;
  out.y[i] = any ? static_cast<float>(look.y / count) : nan;
  out.surface_m[i] = any ? static_cast<float>(surface_m / count) : nan;
  out.stretch_m[i] = any ? static_cast<float>(stretch_m / count) : nan;
}

/// Mean step of the look from a pixel to the one `stride` places on, over the pairs that are seen.
bool mean_step(const LookTile& tile, int stride, glm::dvec2& step) {
  glm::dvec2 sum(0.0);
  int count = 0;
  for (int i = 0; i + stride < tile_samples; ++i) {
    if (stride == 1 && i % tile_side == tile_side - 1) continue;
    if (!seen(tile, i) || !seen(tile, i + stride)) continue;
    sum += glm::dvec2(tile.x[i + stride] - tile.x[i], tile.y[i + stride] - tile.y[i]);
    ++count;
  }
  if (count == 0) return false;
  step = sum / static_cast<double>(count);
  return true;
}

void set_means(LookTile& tile) {
  glm::dvec2 across, down;
  if (!mean_step(tile, 1, across) || !mean_step(tile, tile_side, down)) return;
  tile.look_per_pixel = {across, down};
  const double area = glm::determinant(tile.look_per_pixel);
  if (!(std::abs(area) > 1e-3 * glm::dot(across, across)) || !(std::abs(area) > 1e-3 * glm::dot(down, down))) return;
  tile.pixel_per_look = glm::inverse(tile.look_per_pixel);
  glm::dvec2 look(0.0);
  double surface_m = 0.0;
  double stretch_m = 0.0;
  int count = 0;
  for (int i = 0; i < tile_samples; ++i) {
    if (!seen(tile, i)) continue;
    look += glm::dvec2(tile.x[i], tile.y[i]);
    surface_m += tile.surface_m[i];
    stretch_m += tile.stretch_m[i];
    ++count;
  }
  tile.look = look / static_cast<double>(count);
  tile.surface_mean_m = surface_m / count;
  tile.stretch_mean_m = stretch_m / count;
  tile.usable = true;
}

struct Pixel {
  const LookTile* tile;
  int i;
  bool seen() const { return tile->x[i] == tile->x[i]; }
  glm::dvec2 look() const { return {tile->x[i], tile->y[i]}; }
};

Pixel pixel_at(const PixelLooks& looks, int x, int y) {
  const int tile = y / tile_side * looks.grid.columns() + x / tile_side;
  return {&looks.tiles[static_cast<std::size_t>(tile)], y % tile_side * tile_side + x % tile_side};
}

/// Follows one line of pixels and marks both ends of every step that is not what its tile's mean step says. Pixels that
/// are not seen are stepped over.
void tear_line(PixelLooks& looks, int x, int y, int dx, int dy, int count) {
  constexpr double tolerance = 0.5;
  int last = -1;
  for (int i = 0; i < count; ++i) {
    const Pixel here = pixel_at(looks, x + i * dx, y + i * dy);
    if (!here.seen()) continue;
    if (last >= 0) {
      const Pixel before = pixel_at(looks, x + last * dx, y + last * dy);
      const glm::dvec2 step = (here.look() - before.look()) / static_cast<double>(i - last);
      const glm::dvec2 usual = here.tile->look_per_pixel[dx == 1 ? 0 : 1];
      const bool whole = here.tile->usable && glm::length(step - usual) < tolerance * glm::length(usual);
      if (!whole) {
        for (const int end : {i, last}) {
          looks.torn[static_cast<std::size_t>((y + end * dy) * looks.grid.width_px + x + end * dx)] = 1;
        }
      }
    }
    last = i;
  }
}

}  // namespace

PixelLooks pixel_looks(const EyeHits& hits, const TileGrid& grid, int subsamples, double lens_to_pupil_m) {
  PixelLooks looks;
  looks.grid = grid;
  looks.tiles.resize(grid.count());
  tbb::parallel_for(std::size_t{0}, looks.tiles.size(), [&](std::size_t tile) {
    LookTile& out = looks.tiles[tile];
    for (int i = 0; i < tile_samples; ++i) set_pixel(hits, tile, grid.count(), subsamples, lens_to_pupil_m, i, out);
    set_means(out);
  });
  looks.torn.assign(static_cast<std::size_t>(grid.width_px) * static_cast<std::size_t>(grid.height_px), 0);
  tbb::parallel_for(0, grid.height_px, [&](int y) { tear_line(looks, 0, y, 1, 0, grid.width_px); });
  tbb::parallel_for(0, grid.width_px, [&](int x) { tear_line(looks, x, 0, 0, 1, grid.height_px); });
  return looks;
}

}  // namespace focalstage
