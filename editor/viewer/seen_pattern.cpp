#include "editor/viewer/seen_pattern.h"

#include <string>
#include <vector>

#include "core/retina/retinas.h"
#include "editor/pipeline/seen_show.h"

namespace focalstage {
namespace {

constexpr double pupil_m = 0.004;
constexpr int picture_px = 640;

}  // namespace

void SeenPattern::each(const std::function<void(const glm::dvec2& look, double light)>& take) const {
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      take(look_of_pixel(view, {x + 0.5, y + 0.5}), image.rgb[3 * static_cast<std::size_t>(y * image.width_px + x)]);
    }
  }
}

Result<SeenPattern> see_pattern(const ShowReader& show, std::size_t frame, const TrueEye& eye, double fov_deg,
                                const glm::dvec2& gaze) {
  const auto seen = SeenShow::of(show, "pattern", static_cast<int>(frame), eye.side);
  if (!seen) return seen.fault();
  std::vector<RetinaInput> inputs = seen->inputs();
  for (RetinaInput& input : inputs) {
    if (eye.lens_to_pupil_m) input.lens_to_pupil_m = *eye.lens_to_pupil_m;
    for (RetinaExposure& exposure : input.exposures) {
      for (PowerShare& part : exposure.powers) part.power_d += eye.power_error_d;
    }
  }
  RetinaView view;
  view.eye = eye.side;
  view.focus_d = eye.focus_d;
  view.pupil_m = pupil_m;
  view.width_px = view.height_px = picture_px;
  view.fov_deg = fov_deg;
  view.gaze = gaze;
  view.head_offset_m = eye.pupil_offset_m;
  Retinas retinas;
  auto picture = retinas.view(inputs, view);
  if (!picture) return picture.fault();
  return SeenPattern{view, *std::move(picture)};
}

Fault nothing_seen(std::size_t frame, const std::string& what) {
  return {"viewer.dark", "frame " + std::to_string(frame), what + " is not seen",
          "see that the projector reaches the surface around the gaze"};
}

}  // namespace focalstage
