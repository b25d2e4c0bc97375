#include "core/retina/disc.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace focalstage {
namespace {

/// The columns of a row that hold any light.
struct Extent {
  int begin = 0;
  int end = 0;
};

Extent extent_of(const float* row, int width_px) {
  Extent extent{0, width_px};
  while (extent.end > 0 && row[extent.end - 1] == 0.0f) --extent.end;
  while (extent.begin < extent.end && row[extent.begin] == 0.0f) ++extent.begin;
  return extent;
}

void add_shifted(const float* from, int shift_px, float share, Extent extent, int width_px, float* onto) {
  const int begin = std::max(0, extent.begin + shift_px), end = std::min(width_px, extent.end + shift_px);
  const float* const moved = from - shift_px;
  for (int x = begin; x < end; ++x) onto[x] += share * moved[x];
}

}  // namespace

Disc disc_of(double radius_px) {
  constexpr int fine = 16;  // places per pixel and direction
  Disc disc;
  disc.reach_px = static_cast<int>(std::ceil(std::max(0.0, radius_px - 0.5)));
  if (radius_px <= 0.0) {
    disc.share = {1.0f};
    return disc;
  }
  const int side = 2 * disc.reach_px + 1;
  std::vector<int> inside(static_cast<std::size_t>(side * side), 0);
  int all = 0;
  for (int y = 0; y < side * fine; ++y) {
    for (int x = 0; x < side * fine; ++x) {
      const double dx = (x + 0.5) / fine - 0.5 * side, dy = (y + 0.5) / fine - 0.5 * side;
      if (dx * dx + dy * dy > radius_px * radius_px) continue;
      ++inside[static_cast<std::size_t>(y / fine * side + x / fine)];
      ++all;
    }
  }
  for (const int count : inside) disc.share.push_back(static_cast<float>(count) / static_cast<float>(all));
  return disc;
}

void add_spread(const Disc& disc, const float* from, int width_px, int height_px, float* onto) {
  const auto width = static_cast<std::size_t>(width_px);
  std::vector<Extent> extents;
  for (int y = 0; y < height_px; ++y)
    extents.push_back(extent_of(from + static_cast<std::size_t>(y) * width, width_px));
  const int reach = disc.reach_px;
  tbb::parallel_for(0, height_px, [&](int y) {
    float* const own = onto + static_cast<std::size_t>(y) * width;
    for (int source = std::max(0, y - reach); source <= std::min(height_px - 1, y + reach); ++source) {
      const Extent extent = extents[static_cast<std::size_t>(source)];
      if (extent.begin >= extent.end) continue;
      const float* const light = from + static_cast<std::size_t>(source) * width;
      for (int dx = -reach; dx <= reach; ++dx) {
        const float share = disc.row(source - y)[dx];
        if (share > 0.0f) add_shifted(light, dx, share, extent, width_px, own);
      }
    }
  });
}

}  // namespace focalstage
