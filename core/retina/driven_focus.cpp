#include "core/retina/driven_focus.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "core/optics/vergence.h"
#include "core/retina/lens_rim.h"
#include "core/retina/slice_maps.h"

namespace focalstage {
namespace {

/// Sums over the exposures of one pixel.
struct FocusSum {
  double luminance = 0.0;
  double vergence_d = 0.0;
  double square_d2 = 0.0;

  void add(double light, double own_d) {
    luminance += light;
    vergence_d += light * own_d;
    square_d2 += light * own_d * own_d;
  }
};

void put(const FocusSum& sum, std::size_t pixel, DrivenFocus& focus) {
  focus.luminance[pixel] = static_cast<float>(sum.luminance);
  if (!(sum.luminance > 0.0)) return;
  const double mean_d = sum.vergence_d / sum.luminance;
  focus.vergence_d[pixel] = static_cast<float>(mean_d);
  focus.spread_d[pixel] = static_cast<float>(std::sqrt(std::max(0.0, sum.square_d2 / sum.luminance - mean_d * mean_d)));
}

}  // namespace

DrivenFocus driven_focus_of(const std::vector<SeenPass>& passes, const RetinaInput& input, const RetinaView& view,
                            int margin_px, const std::stop_token& stop) {
  const auto pixels = static_cast<std::size_t>(view.width_px) * static_cast<std::size_t>(view.height_px);
  DrivenFocus focus{view.width_px, view.height_px, std::vector<float>(pixels, 0.0f),
                    std::vector<float>(pixels, SliceSpot::none), std::vector<float>(pixels, SliceSpot::none)};
  const LensRim rim(input, view);
  const LookGrid grid = grid_of(view, margin_px);
  tbb::parallel_for(0, view.height_px, [&](int y) {
    for (int x = 0; x < view.width_px && !stop.stop_requested(); ++x) {
      FocusSum sum;
      const int column = x + margin_px, row = y + margin_px;
      for (const SeenPass& pass : passes) {
        const SliceSpot& spot = pass.map->spot(column, row);
        if (!spot.lit()) continue;
        const double open = double{pass.share} * rim.open_share(grid.look(column, row), spot.vergence_d);
        sum.add(open * luminance_at(*pass.light, spot.x_px, spot.y_px),
                vergence_at_lens_d(spot.vergence_d, input.lens_to_pupil_m));
      }
      put(sum, static_cast<std::size_t>(y) * static_cast<std::size_t>(view.width_px) + static_cast<std::size_t>(x),
          focus);
    }
  });
  return focus;
}

}  // namespace focalstage
