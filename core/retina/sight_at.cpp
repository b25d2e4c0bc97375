#include "core/retina/sight_at.h"

#include <algorithm>

#include "core/retina/slice_eye.h"

namespace focalstage {
namespace {

constexpr int widest = 4;  ///< pixels to each side

struct Pixel {
  int column, row;
};

const SliceSpot& spot_in(const SliceMap& map, Pixel pixel) {
  return map.spots[static_cast<std::size_t>(pixel.row) * static_cast<std::size_t>(map.grid.width_px) +
                   static_cast<std::size_t>(pixel.column)];
}

glm::dvec3 world_of(const SliceMap& map, Pixel pixel, const Eye& eye) {
  const double surface_m = spot_in(map, pixel).surface_m;
  const double narrowing = 1.0 - map.power_d * eye.lens_to_pupil_m;
  const glm::dvec2 aside = map.grid.look(pixel.column, pixel.row) * (eye.lens_to_pupil_m + surface_m * narrowing);
  return eye.eye_from_world.inverse().point({aside, -(eye.lens_to_pupil_m + surface_m)});
}

double luminance(const std::array<float, 3>& light, int channels) {
  return channels == 1 ? light[0] : 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2];
}

/// What several exposures and pixels show together.
struct Mean {
  double luminance = 0.0;
  double vergence_d = 0.0;  ///< times luminance
  double most = 0.0;
  RetinaSight brightest;

  void add(const SliceMap& map, const SliceLight& light, Pixel pixel, const Eye& eye) {
    const SliceSpot& spot = spot_in(map, pixel);
    if (!light.any || !spot.lit()) return;
    const double own = focalstage::luminance(light.at(spot.x_px, spot.y_px), light.channels);
    luminance += own;
    vergence_d += own * vergence_at_lens_d(spot.vergence_d, eye.lens_to_pupil_m);
    if (own <= most) return;
    most = own;
    brightest = {world_of(map, pixel, eye), spot.surface_m, 0.0, true};
  }
};

}  // namespace

std::optional<RetinaSight> sight_at(const std::vector<const SliceMap*>& maps, const std::vector<SliceLight>& lights,
                                    const Eye& eye, int column, int row) {
  const LookGrid& grid = maps.back()->grid;
  for (int side = 0; side <= widest; ++side) {
    Mean mean;
    for (int y = std::max(0, row - side); y <= std::min(grid.height_px - 1, row + side); ++y) {
      for (int x = std::max(0, column - side); x <= std::min(grid.width_px - 1, column + side); ++x) {
        for (std::size_t i = 0; i < lights.size(); ++i) mean.add(*maps[i], lights[i], {x, y}, eye);
      }
    }
    if (!(mean.luminance > 0.0)) continue;
    mean.brightest.vergence_d = mean.vergence_d / mean.luminance;
    return mean.brightest;
  }
  const SliceMap& bare = *maps.back();
  const double surface_m = spot_in(bare, {column, row}).surface_m;
  if (!(surface_m > 0.0)) return std::nullopt;
  return RetinaSight{world_of(bare, {column, row}, eye), surface_m, 1.0 / surface_m, false};
}

}  // namespace focalstage
