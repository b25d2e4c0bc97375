#include "core/compile/frame_run.h"

#include <cstring>

namespace focalstage {

void add_surface_light(const FrameRun& run, const TileMet& met, TileLight& light) {
  if (!met.any) return;
  for (int i = 0; i < tile_samples; ++i) {
    if (met.drawable[i] < 0) continue;
    const std::uint32_t owner = (*run.surfaces)[static_cast<std::size_t>(met.drawable[i])].owner;
    const auto amount = static_cast<float>(run.stage->surfaces[owner].illumination) * run.slice.share;
    for (int c = 0; c < run.slice.channels; ++c) light.channel[c][i] += amount;
    light.any = light.any || amount > 0.0f;
  }
}

void light_of_tile(const FrameRun& run, const ImageSpec& image, int column, int row, TileLight& light,
                   std::vector<ObjectTally>& tallies) {
  light.any = false;
  std::memset(light.channel, 0, sizeof(float) * tile_samples * static_cast<std::size_t>(run.slice.channels));
  if (run.slice.keeps_weights) std::memset(light.weight, 0, sizeof(light.weight));
  const TileGrid& grid = run.rays->grid;
  for (int subsample = 0; subsample < run.rays->subsamples; ++subsample) {
    const std::size_t at = static_cast<std::size_t>(subsample) * grid.count() +
                           static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns()) +
                           static_cast<std::size_t>(column);
    if (image.kind != ImageKind::surface_light) {
      const Side side = image.eye == ImageEye::left ? Side::left : Side::right;
      const EyeView& view = *run.views[side];
      const EyeTile& tile = run.hits[side]->tiles[at];
      const auto slice = static_cast<std::size_t>(image.slice);
      if (may_be_lit(view, tile, run.slices[slice], slice)) {
        slice_tile(run.slice, view, tile, run.slices[slice], slice, light, tallies);
      }
    }
    if (image.kind != ImageKind::content) add_surface_light(run, run.met->tiles[at], light);
  }
}

}  // namespace focalstage
