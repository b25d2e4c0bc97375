#include "editor/preview/eye_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/percept/seen_frame.h"
#include "editor/tools/srgb.h"

namespace focalstage {
namespace {

float luminance(const float* rgb) { return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2]; }

/// The image of `side` whose exposure is on at a moment of the sweep, or the nearest to it in time.
int image_at(const Schedule& schedule, Side side, double time_s) {
  int nearest = -1;
  double least_s = INFINITY;
  for (const Slot& slot : schedule.slots) {
    if (slot.eye != side) continue;
    const double away_s = std::max({slot.start_s - time_s, time_s - slot.start_s - slot.exposure_s, 0.0});
    if (away_s < least_s) {
      least_s = away_s;
      nearest = slot.image;
    }
  }
  return nearest;
}

}  // namespace

RetinaInput retina_input(const CompiledSlices& compiled, const Schedule& schedule, Side side, const EyeWish& wish) {
  Schedule shown = schedule;
  if (wish.sweep_time_s) {
    const int only = image_at(schedule, side, *wish.sweep_time_s);
    std::erase_if(shown.slots, [&](const Slot& slot) { return slot.image != only || slot.eye != side; });
  }
  return seen_frame(*compiled.stage, compiled.settings, compiled.images, shown, worn_glasses(compiled.project->glasses),
                    side);
}

RetinaView retina_view(const EyeWish& wish, Side side) {
  RetinaView view;
  view.eye = side;
  view.focus_d = wish.focus_d;
  view.pupil_m = wish.pupil_mm / 1000.0;
  view.width_px = wish.width_px;
  view.height_px = wish.height_px;
  view.fov_deg = wish.fov_deg;
  view.head_offset_m = wish.head_offset_m;
  return view;
}

RetinaInput EyePainter::conventional_input(const CompiledSlices& compiled, Side side) const {
  const CompileSettings settings =
      SliceMaker::settings_of(*compiled.project, SliceMaker::Variant::conventional, compiled.divisor);
  // The lens rests, the shutters are open while their eye's image is on.
  RetinaInput input =
      seen_frame(*compiled.stage, settings, conventional_.images, {}, worn_glasses(compiled.project->glasses), side);
  for (std::size_t i = 0; i < settings.images.size(); ++i) {
    const ImageEye eye = settings.images[i].eye;
    const bool own = eye == ImageEye::both || static_cast<std::size_t>(eye) == index_of(side);
    if (own) input.exposures.push_back({conventional_.images.image(i), {{0.0, 1.0}}, true});
  }
  return input;
}

const Schedule& EyePainter::schedule_of(const CompiledSlices& compiled) {
  if (scheduled_ != compiled.project) {
    scheduled_ = compiled.project;
    schedule_ = make_schedule(*compiled.project, compiled.settings.images).schedule;
  }
  return schedule_;
}

RetinaInput EyePainter::input_for(const CompiledSlices& compiled, const EyeWish& wish, Side side) {
  if (wish.conventional) return conventional_input(compiled, side);
  return retina_input(compiled, schedule_of(compiled), side, wish);
}

Status EyePainter::make_conventional(const CompiledSlices& compiled, SliceMaker& maker, std::stop_token stop) {
  const bool stands = conventional_revision_ == compiled.revision && conventional_frame_ == compiled.frame &&
                      conventional_divisor_ == compiled.divisor;
  if (stands) return {};
  auto made = maker.make(*compiled.project, *compiled.stage, SliceMaker::Variant::conventional, compiled.divisor,
                         std::move(stop));
  if (!made) return made.fault();
  conventional_ = std::move(*made);
  conventional_revision_ = compiled.revision;
  conventional_frame_ = compiled.frame;
  conventional_divisor_ = compiled.divisor;
  return {};
}

Result<EyePicture> EyePainter::paint(const CompiledSlices& compiled, const EyeWish& wish, SliceMaker& maker,
                                     std::stop_token stop) {
  if (wish.conventional) {
    if (Status made = make_conventional(compiled, maker, stop); !made) return made.fault();
  }
  EyePicture picture{compiled.revision, compiled.divisor, wish.width_px, wish.height_px, wish.focus_d, {}};
  picture.rgb.assign(static_cast<std::size_t>(wish.width_px) * static_cast<std::size_t>(wish.height_px) * 3, 0);
  const bool both = wish.left && wish.right;
  for (const Side side : both_sides) {
    if (!(side == Side::left ? wish.left : wish.right)) continue;
    const auto seen = retinas_[index_of(side)].view(input_for(compiled, wish, side), retina_view(wish, side), stop);
    if (!seen) return seen.fault();
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
      const float* light = &seen->rgb[i];
      if (!both) {
        for (std::size_t c = 0; c < 3; ++c) picture.rgb[i + c] = srgb_code(light[c]);
      } else if (side == Side::left) {
        picture.rgb[i] = srgb_code(luminance(light));
      } else {
        picture.rgb[i + 1] = picture.rgb[i + 2] = srgb_code(luminance(light));
      }
    }
  }
  return picture;
}

Result<std::optional<double>> EyePainter::focus_at(const CompiledSlices& compiled, const EyeWish& wish, glm::dvec2 at) {
  const Side side = wish.left ? Side::left : Side::right;
  const RetinaView view = retina_view(wish, side);
  const glm::dvec2 look = look_of_pixel(view, at * glm::dvec2(view.width_px, view.height_px));
  const auto sight =
      retinas_[index_of(side)].look_at(retina_input(compiled, schedule_of(compiled), side, wish), view, look);
  if (!sight) return sight.fault();
  if (!*sight) return std::optional<double>{};
  return std::optional<double>{(*sight)->vergence_d};
}

}  // namespace focalstage
