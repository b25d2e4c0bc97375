#include "editor/window/views/room_overlay.h"

#include <algorithm>

#include "editor/window/base/theme.h"
#include "editor/window/views/room_marks.h"

namespace focalstage {
namespace {

constexpr std::size_t most_traced = 48;
constexpr std::uint32_t also_selected = theme::colour(0x8FBEFF);

void stroke(const RoomFrame& frame, RoomDrawing& drawing, const std::vector<Outline>& lines, std::uint32_t colour,
            double width_px) {
  std::vector<ImVec2> points;
  for (const Outline& line : lines) {
    points.clear();
    for (const glm::dvec2& point : line) points.push_back(frame.on_window(point));
    drawing.list().AddPolyline(points.data(), static_cast<int>(points.size()), colour, ImDrawFlags_Closed,
                               static_cast<float>(width_px * frame.scale));
  }
}

void draw_box(const RoomFrame& frame, const RoomHands& hands, RoomDrawing& drawing) {
  if (!hands.box_px) return;
  const ImVec2 a = frame.on_window(glm::min(hands.box_px->first, hands.box_px->second));
  const ImVec2 b = frame.on_window(glm::max(hands.box_px->first, hands.box_px->second));
  drawing.list().AddRectFilled(a, b, theme::with_alpha(theme::accent, 0.10));
  drawing.list().AddRect(a, b, theme::with_alpha(theme::accent, 0.9));
}

}  // namespace

const std::vector<Outline>& RoomOverlay::traced(const RoomFrame& frame, const StagedName& thing) {
  const std::shared_ptr<const Stage>& stage = frame.session.stage();
  for (const Traced& known : traced_) {
    if (known.thing == thing && known.stage == stage && known.view == frame.view) return known.lines;
  }
  std::erase_if(traced_, [&](const Traced& known) {
    return known.thing == thing || known.stage != stage || known.view != frame.view;
  });
  const std::vector<Drawable> drawables = frame.scene.light(drawables_of(frame.stage, frame.scene.fixtures(), thing));
  traced_.push_back({stage, frame.view, thing, outlines(frame.view, drawables, frame.scale)});
  return traced_.back().lines;
}

void RoomOverlay::draw_outlines(const RoomFrame& frame, const RoomHands& hands, RoomDrawing& drawing) {
  const Selection& selection = frame.session.selection();
  const auto is_beholder = [&](const StagedName& thing) {
    return (thing.list == "viewer" && !frame.has_camera()) ||
           (thing.list == "projectors" && frame.session.view().look_through == LookThrough::projector);
  };
  if (hands.hot_thing && !selection.has({hands.hot_thing->list, hands.hot_thing->name}) &&
      !is_beholder(*hands.hot_thing)) {
    stroke(frame, drawing, traced(frame, *hands.hot_thing), theme::with_alpha(theme::text, 0.55), 1.25);
  }
  const std::size_t from = selection.things.size() > most_traced ? selection.things.size() - most_traced : 0;
  for (std::size_t i = from; i < selection.things.size(); ++i) {
    const StagedName thing{selection.things[i].list, selection.things[i].name};
    if (is_beholder(thing)) continue;
    const bool primary = i + 1 == selection.things.size();
    stroke(frame, drawing, traced(frame, thing), primary ? theme::accent : also_selected, primary ? 2.0 : 1.5);
  }
}

void RoomOverlay::draw(const RoomFrame& frame, const RoomHands& hands) {
  RoomDrawing drawing(frame);
  if (frame.has_camera()) draw_floor_marks(frame, drawing);
  draw_frusta(frame, drawing);
  draw_gaze(frame, drawing);
  draw_picture_edge(frame, drawing);
  draw_outlines(frame, hands, drawing);
  draw_depth(frame, hands, drawing);
  draw_names(frame, hands, drawing);
  draw_sheet_labels(frame, drawing);
  draw_handles(frame, hands, drawing);
  draw_measure(frame, hands, drawing);
  draw_box(frame, hands, drawing);
  draw_slice_legend(frame, drawing);
  draw_first_steps(frame, drawing);
}

}  // namespace focalstage
