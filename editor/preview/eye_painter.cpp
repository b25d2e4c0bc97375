#include "editor/preview/eye_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/luminance.h"
#include "core/percept/conflict.h"
#include "core/percept/seen_frame.h"
#include "editor/tools/srgb.h"

namespace focalstage {
namespace {

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

/// The same light in the rig as it is.
RetinaInput seen_in(const SeenRig* rig, RetinaInput input) {
  if (rig == nullptr) return input;
  input.stage = rig->stage.get();
  input.projector.world_from_projector = rig->world_from_projector;
  input.lens_to_pupil_m = rig->lens_to_pupil_m;
  for (RetinaExposure& exposure : input.exposures) {
    for (PowerShare& share : exposure.powers) share.power_d += rig->power_d;
  }
  return input;
}

}  // namespace

RetinaInput retina_input(const CompiledSlices& compiled, const Schedule& schedule, Side side, const EyeWish& wish) {
  Schedule shown = schedule;
  if (wish.sweep_time_s) {
    const int only = image_at(schedule, side, *wish.sweep_time_s);
    std::erase_if(shown.slots, [&](const Slot& slot) { return slot.image != only || slot.eye != side; });
  }
  return seen_in(wish.rig.get(),
                 seen_frame(*compiled.stage, compiled.settings, compiled.images, shown,
                            worn_glasses(compiled.project->glasses), side, room_light_of(*compiled.project)));
}

RetinaView retina_view(const EyeWish& wish, Side side, std::size_t panels) {
  RetinaView view;
  view.eye = side;
  view.focus_d = wish.focus_d;
  view.pupil_m = wish.pupil_mm / 1000.0;
  view.width_px = std::max(1, wish.width_px / static_cast<int>(panels));
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

RetinaInput EyePainter::input_for(const CompiledSlices& compiled, const EyeWish& wish, const EyePanel& panel,
                                  Side side) {
  if (panel.projection == EyeProjection::conventional) {
    return seen_in(wish.rig.get(), conventional_input(compiled, side));
  }
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

Status EyePainter::paint_panel(const CompiledSlices& compiled, const EyeWish& wish, std::size_t panel,
                               EyePicture& picture, const std::stop_token& stop) {
  const EyeLook look = picture.panels[panel].look;
  for (const Side side : both_sides) {
    if (look != EyeLook::red_cyan && look != (side == Side::left ? EyeLook::left : EyeLook::right)) continue;
    const RetinaView view = retina_view(wish, side, picture.panels.size());
    const auto seen =
        retina_of(picture.panels[panel], side).view(input_for(compiled, wish, picture.panels[panel], side), view, stop);
    if (!seen) return seen.fault();
    const auto first = static_cast<std::size_t>(view.width_px) * panel;
    for (std::size_t i = 0; i < seen->rgb.size() / 3; ++i) {
      const float* light = &seen->rgb[3 * i];
      const auto width = static_cast<std::size_t>(view.width_px);
      std::uint8_t* rgb =
          &picture.rgb[3 * (i / width * static_cast<std::size_t>(picture.width_px) + first + i % width)];
      if (look != EyeLook::red_cyan) {
        for (std::size_t c = 0; c < 3; ++c) rgb[c] = srgb_code(light[c]);
      } else if (side == Side::left) {
        rgb[0] = srgb_code(luminance(light[0], light[1], light[2]));
      } else {
        rgb[1] = rgb[2] = srgb_code(luminance(light[0], light[1], light[2]));
      }
    }
  }
  return {};
}

/// Tints a panel where its eye (the left one, if both) would have to converge and to focus at different distances.
Status EyePainter::add_conflicts(const CompiledSlices& compiled, const EyeWish& wish, std::size_t panel,
                                 EyePicture& picture, const std::stop_token& stop) {
  constexpr double tint = 0.55, comfortable_tint = 0.2;
  const Side side = picture.panels[panel].look == EyeLook::right ? Side::right : Side::left;
  const RetinaInput input = input_for(compiled, wish, picture.panels[panel], side);
  const RetinaView view = retina_view(wish, side, picture.panels.size());
  const auto focus = retina_of(picture.panels[panel], side).driven_focus(input, view, stop);
  if (!focus) return focus.fault();
  const ThingMap things = things_seen(input, view, {}, stop);
  if (stop.stop_requested()) return Fault{"retina.cancelled", "", "stopped before the picture was done", ""};
  const std::vector<float> map = conflict_map(things, *focus);
  const auto width = static_cast<std::size_t>(view.width_px);
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (std::isnan(map[i])) continue;
    const auto colour = conflict_colour(map[i]);
    const double share = std::abs(map[i]) <= comfort_d ? comfortable_tint : tint;
    std::uint8_t* rgb =
        &picture.rgb[3 * (i / width * static_cast<std::size_t>(picture.width_px) + width * panel + i % width)];
    for (std::size_t c = 0; c < 3; ++c) {
      rgb[c] = static_cast<std::uint8_t>(std::lround((1.0 - share) * rgb[c] + share * colour[c]));
    }
  }
  if (panel > 0) return {};
  for (const ThingConflict& conflict : thing_conflicts(things, *focus)) {
    const SeenThing& thing = things.things[conflict.thing];
    if (thing.kind == SeenThing::Kind::object && conflict.light > 0.0)
      picture.conflicts.push_back({thing.name, conflict.mean_d});
  }
  return {};
}

std::vector<EyePanel> panels_of(const EyeWish& wish) {
  std::vector<EyePanel> panels;
  for (const EyeProjection projection : {EyeProjection::multifocal, EyeProjection::conventional}) {
    if (wish.projection != EyeProjection::both && wish.projection != projection) continue;
    if (wish.look == EyeLook::side_by_side) {
      panels.push_back({EyeLook::left, projection});
      panels.push_back({EyeLook::right, projection});
    } else {
      panels.push_back({wish.look, projection});
    }
  }
  return panels;
}

Result<EyePicture> EyePainter::paint(const CompiledSlices& compiled, const EyeWish& wish, SliceMaker& maker,
                                     std::stop_token stop) {
  if (wish.projection != EyeProjection::multifocal) {
    if (Status made = make_conventional(compiled, maker, stop); !made) return made.fault();
  }
  EyePicture picture;
  picture.revision = compiled.revision;
  picture.divisor = compiled.divisor;
  picture.width_px = wish.width_px;
  picture.height_px = wish.height_px;
  picture.focus_d = wish.focus_d;
  picture.off = wish.rig != nullptr;
  picture.panels = panels_of(wish);
  picture.rgb.assign(static_cast<std::size_t>(wish.width_px) * static_cast<std::size_t>(wish.height_px) * 3, 0);
  for (std::size_t panel = 0; panel < picture.panels.size(); ++panel) {
    if (Status done = paint_panel(compiled, wish, panel, picture, stop); !done) return done.fault();
    if (!wish.conflict) continue;
    if (Status done = add_conflicts(compiled, wish, panel, picture, stop); !done) return done.fault();
  }
  return picture;
}

Result<std::optional<double>> EyePainter::focus_at(const CompiledSlices& compiled, const EyeWish& wish, glm::dvec2 at) {
  const std::vector<EyePanel> panels = panels_of(wish);
  const auto count = static_cast<double>(panels.size());
  const double panel = std::clamp(std::floor(at.x * count), 0.0, count - 1.0);
  const EyePanel& asked = panels[static_cast<std::size_t>(panel)];
  const Side side = asked.look == EyeLook::right ? Side::right : Side::left;
  const RetinaView view = retina_view(wish, side, panels.size());
  const glm::dvec2 within{at.x * count - panel, at.y};
  const glm::dvec2 look = look_of_pixel(view, within * glm::dvec2(view.width_px, view.height_px));
  // What can be focused on is what the sweep puts there, also where a conventional projection stands beside it.
  const auto sight =
      retinas_[index_of(side)][0].look_at(retina_input(compiled, schedule_of(compiled), side, wish), view, look);
  if (!sight) return sight.fault();
  if (!*sight) return std::optional<double>{};
  return std::optional<double>{(*sight)->vergence_d};
}

}  // namespace focalstage
