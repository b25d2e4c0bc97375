#include "core/retina/slice_map.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "core/retina/spotter.h"

namespace focalstage {
namespace {

/// How far apart neighbouring looks lie in the projector's image, summed; only where they see one face.
struct Footprint {
  glm::dvec2 apart_px{0.0};
  int count = 0;
};

/// Of every fourth look along a row.
Footprint footprint_of_row(const SurfaceRaster& raster, const std::vector<SliceSpot>& spots, int row, int margin_px) {
  Footprint sum;
  const auto width = static_cast<std::size_t>(raster.grid.width_px);
  const SliceSpot* own = &spots[static_cast<std::size_t>(row) * width];
  for (int column = margin_px; column + margin_px + 1 < raster.grid.width_px; column += 4) {
    const SliceSpot &a = own[column], &b = own[column + 1], &c = own[static_cast<std::size_t>(column) + width];
    if (!a.lit() || !b.lit() || !c.lit()) continue;
    const std::uint32_t face = raster.at(column, row);
    if (raster.at(column + 1, row) != face || raster.at(column, row + 1) != face) continue;
    sum.apart_px.x += std::abs(b.x_px - a.x_px) + std::abs(c.x_px - a.x_px);
    sum.apart_px.y += std::abs(b.y_px - a.y_px) + std::abs(c.y_px - a.y_px);
    ++sum.count;
  }
  return sum;
}

void measure(const SurfaceRaster& raster, int margin_px, SliceMap& map) {
  const auto include = [&](const SliceSpot& spot) {
    if (!spot.lit()) return;
    map.lowest_vergence_d = map.any ? std::min(map.lowest_vergence_d, spot.vergence_d) : spot.vergence_d;
    map.highest_vergence_d = map.any ? std::max(map.highest_vergence_d, spot.vergence_d) : spot.vergence_d;
    map.most_spread_px = std::max(map.most_spread_px, spot.spread_px);
    map.any = true;
  };
  for (const SliceSpot& spot : map.spots) include(spot);
  for (const std::vector<EdgePixel>& row : map.edges) {
    for (const EdgePixel& pixel : row) {
      for (const SliceSpot& part : pixel.spots) include(part);
    }
  }
  Footprint sum;
  for (int row = margin_px; row + margin_px + 1 < map.grid.height_px; row += 4) {
    const Footprint one = footprint_of_row(raster, map.spots, row, margin_px);
    sum.apart_px += one.apart_px;
    sum.count += one.count;
  }
  if (sum.count > 0) map.seen_px = sum.apart_px / static_cast<double>(sum.count);
}

}  // namespace

SliceMap slice_map(const SliceScene& scene, const SliceEye& eye, const LookGrid& grid, const std::stop_token& stop) {
  SliceMap map;
  map.grid = grid;
  map.power_d = eye.power_d;
  map.spots.resize(static_cast<std::size_t>(grid.width_px) * static_cast<std::size_t>(grid.height_px));
  if (!eye.sees()) return map;
  LookGrid narrowed = grid;
  narrowed.first *= eye.narrowing;
  narrowed.step *= eye.narrowing;
  const SurfaceRaster raster =
      raster_surfaces(scene.mesh, eye.slice_from_world, narrowed, eye.behind_lens_m + nearest_seen_m, stop);
  const Spotter spotter(raster, scene, eye);
  if (scene.paint) map.returns.resize(map.spots.size());
  tbb::parallel_for(0, grid.height_px, [&](int row) {
    if (stop.stop_requested()) return;
    const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width_px);
    spotter.row(grid, row, &map.spots[first], scene.paint ? &map.returns[first] : nullptr);
  });
  if (stop.stop_requested()) return map;
  const std::vector<EdgeFaces::Pixel> edges = spotter.edges(map.spots);
  const EdgeFaces faces(raster, edges);
  std::vector<EdgePixel> parts(edges.size());
  std::vector<EdgeReturns> returns(scene.paint ? edges.size() : 0);
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t i) {
    if (!stop.stop_requested())
      parts[i] = spotter.parts_of(grid, edges[i], faces, scene.paint ? returns[i].data() : nullptr);
  });
  map.edges.resize(static_cast<std::size_t>(grid.height_px));
  map.edge_returns.resize(scene.paint ? map.edges.size() : 0);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    map.edges[static_cast<std::size_t>(edges[i].row)].push_back(parts[i]);
    if (scene.paint) map.edge_returns[static_cast<std::size_t>(edges[i].row)].push_back(returns[i]);
  }
  measure(raster, scene.margin_px, map);
  return map;
}

}  // namespace focalstage
