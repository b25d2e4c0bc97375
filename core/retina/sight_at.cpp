#include "core/retina/sight_at.h"

#include <algorithm>

#include "core/optics/vergence.h"

namespace focalstage {
namespace {

constexpr int widest = 4;  ///< pixels to each side

struct Pixel {
  int column, row;
};

/// The spot of the surface that is seen in a pixel, and its place in the world.
RetinaSight sight_of(const SliceMap& map, Pixel pixel, const Eye& eye) {
  const double vergence_d = vergence_at_lens_d(map.spot(pixel.column, pixel.row).vergence_d, eye.lens_to_pupil_m);
  const double surface_m = 1.0 / (vergence_d + map.power_d);
  const double narrowing = 1.0 - map.power_d * eye.lens_to_pupil_m;
  const glm::dvec2 aside = map.grid.look(pixel.column, pixel.row) * (eye.lens_to_pupil_m + surface_m * narrowing);
  RetinaSight sight;
  sight.world_m = eye.eye_from_world.inverse().point({aside, -(eye.lens_to_pupil_m + surface_m)});
  sight.surface_m = surface_m;
  sight.vergence_d = vergence_d;
  return sight;
}

/// What several exposures and pixels show together.
struct Mean {
  double luminance = 0.0;
  double vergence_d = 0.0;  ///< times luminance
  double most = 0.0;
  RetinaSight brightest;

  void add(const SeenPass& pass, Pixel pixel, const Eye& eye) {
    const SliceSpot& spot = pass.map->spot(pixel.column, pixel.row);
    if (!spot.lit()) return;
    const double own = pass.share * luminance_at(*pass.light, spot.x_px, spot.y_px);
    luminance += own;
    vergence_d += own * vergence_at_lens_d(spot.vergence_d, eye.lens_to_pupil_m);
    if (own <= most) return;
    most = own;
    brightest = sight_of(*pass.map, pixel, eye);
  }
};

}  // namespace

std::optional<RetinaSight> sight_at(const std::vector<SeenPass>& passes, const SliceMap& bare, const Eye& eye,
                                    int column, int row) {
  const LookGrid& grid = bare.grid;
  for (int side = 0; side <= widest; ++side) {
    Mean mean;
    for (int y = std::max(0, row - side); y <= std::min(grid.height_px - 1, row + side); ++y) {
      for (int x = std::max(0, column - side); x <= std::min(grid.width_px - 1, column + side); ++x) {
        for (const SeenPass& pass : passes) mean.add(pass, {x, y}, eye);
      }
    }
    if (!(mean.luminance > 0.0)) continue;
    mean.brightest.vergence_d = mean.vergence_d / mean.luminance;
    mean.brightest.lit = true;
    return mean.brightest;
  }
  if (!bare.spot(column, row).seen()) return std::nullopt;
  return sight_of(bare, {column, row}, eye);
}

}  // namespace focalstage
