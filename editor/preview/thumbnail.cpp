#include "editor/preview/thumbnail.h"

#include <algorithm>
#include <utility>

#include "editor/preview/eye_painter.h"
#include "editor/preview/slice_maker.h"

namespace focalstage {
namespace {

constexpr int divisor = 2;
/// The thumbnail shares the machine with the window.
constexpr int threads = 1;

/// Where an eye that looks around would find something to focus on; half a metre where there is nothing.
double focus_of(EyePainter& painter, const CompiledSlices& compiled, const EyeWish& wish) {
  for (const double y : {0.5, 0.4, 0.6, 0.3, 0.7}) {
    for (const double x : {0.5, 0.4, 0.6, 0.3, 0.7}) {
      const auto found = painter.focus_at(compiled, wish, {x, y});
      if (found && *found) return std::clamp(**found, -1.0, 10.0);
    }
  }
  return 2.0;
}

}  // namespace

Result<EyePicture> paint_thumbnail(const Project& project, std::shared_ptr<const Stage> stage, int width_px,
                                   int height_px, std::stop_token stop) {
  SliceMaker maker(threads);
  auto made = maker.make(project, *stage, SliceMaker::Variant::shown, divisor, stop);
  if (!made) return made.fault();
  CompiledSlices compiled;
  compiled.divisor = divisor;
  compiled.project = std::make_shared<const Project>(project);
  compiled.stage = std::move(stage);
  compiled.settings = SliceMaker::settings_of(project, SliceMaker::Variant::shown, divisor);
  compiled.images = std::move(made->images);
  EyeWish wish;
  wish.width_px = width_px;
  wish.height_px = height_px;
  EyePainter painter;
  wish.focus_d = focus_of(painter, compiled, wish);
  return painter.paint(compiled, wish, maker, std::move(stop));
}

}  // namespace focalstage
