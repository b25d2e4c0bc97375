#include "editor/window/views/time_pane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/number_words.h"
#include "core/base/periodic.h"
#include "editor/session/session.h"
#include "editor/tools/slice_tint.h"
#include "editor/window/base/chips.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/views/pane_text.h"
#include "editor/window/views/sweep_curves.h"

namespace focalstage {
namespace {

std::uint32_t packed(const glm::dvec3& rgb) {
  const auto code = [](double v) { return static_cast<std::uint32_t>(std::lround(255.0 * std::clamp(v, 0.0, 1.0))); };
  return theme::colour((code(rgb.x) << 16) | (code(rgb.y) << 8) | code(rgb.z));
}

/// Round steps of an axis: 1, 2 or 5 times a power of ten, at most `most` of them.
double step_of(double span, double most) {
  double step = std::pow(10.0, std::floor(std::log10(std::max(span / most, 1e-9))));
  for (const double times : {2.0, 2.5, 2.0}) {
    if (span / step <= most) break;
    step *= times;
  }
  return step;
}

bool is_open(const ShutterTimes& times, double time_s) {
  if (times.open_s <= times.close_s) return time_s >= times.open_s && time_s < times.close_s;
  return time_s >= times.open_s || time_s < times.close_s;
}

}  // namespace

void TimePane::draw(Session& session, const PaneRect& rect) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(to_im(rect.min), to_im(rect.min + rect.size), theme::view);
  const auto checked = session.checked();
  if (!checked) {
    draw_hint(rect, "The sweep appears once there are slices and a projector.");
    return;
  }
  SweepAxes axes;
  axes.schedule = &checked->schedule.schedule;
  axes.period_s = axes.schedule->period_s;
  const Sweep& sweep = session.project().sweep;
  axes.low_d = sweep.min_power_d;
  axes.high_d = sweep.max_power_d;
  for (const double power_d : session.project().slices.powers_d) {
    axes.low_d = std::min(axes.low_d, power_d);
    axes.high_d = std::max(axes.high_d, power_d);
  }
  const auto offer = session.solve_offer();
  if (offer && offer->solved()) {
    axes.low_d = std::min(axes.low_d, offer->report.result.rig->min_power_d);
    axes.high_d = std::max(axes.high_d, offer->report.result.rig->max_power_d);
  }
  const double margin_d = 0.12 * std::max(axes.high_d - axes.low_d, 0.1);
  axes.low_d -= margin_d;
  axes.high_d += margin_d;
  axes.lanes_px = px(44);
  const float left = px(54), right = px(64), top = px(40), bottom = px(24) + axes.lanes_px;
  axes.plot = {{rect.min.x + left, rect.min.y + top}, {rect.size.x - left - right, rect.size.y - top - bottom}};
  if (axes.plot.size.x < px(80) || axes.plot.size.y < px(40)) {
    draw_hint(rect, "Make this view larger to see the sweep.");
    return;
  }
  draw_axes(axes);
  draw_shutters(axes);
  draw_slots(axes);
  draw_powers(axes, sweep);
  if (offer && offer->solved()) draw_offer(axes, *offer);
  scrub(session, axes);
  drag_slices(session, axes);
  draw_reading(axes);
  draw_solve(session, rect);
}

void TimePane::draw_axes(const SweepAxes& axes) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const glm::vec2 min = axes.plot.min, max = axes.plot.min + axes.plot.size;
  const double span_d = axes.high_d - axes.low_d;
  const double power_step_d = step_of(span_d, std::max(2.0, double(axes.plot.size.y / px(28))));
  for (double d = std::ceil(axes.low_d / power_step_d) * power_step_d; d <= axes.high_d; d += power_step_d) {
    const bool zero = std::abs(d) < 1e-9;
    list.AddLine({min.x, axes.y(d)}, {max.x, axes.y(d)}, zero ? theme::faint : theme::line);
    const std::string text = signed_text(zero ? 0.0 : d, power_step_d < 0.1 ? 2 : 1) + " D";
    const glm::vec2 size = small_text_size(text);
    small_text(list, {min.x - size.x - px(6), axes.y(d) - 0.5f * size.y}, text, theme::dim);
  }
  const double time_step_ms = step_of(axes.period_s * 1e3, std::max(2.0, double(axes.plot.size.x / px(48))));
  for (double ms = 0.0; ms <= axes.period_s * 1e3 + 1e-6; ms += time_step_ms) {
    const float x = axes.x(ms * 1e-3);
    list.AddLine({x, max.y}, {x, max.y + px(4)}, theme::faint);
    const std::string text = fixed_text(ms, time_step_ms < 1.0 ? 1 : 0);
    small_text(list, {x - 0.5f * small_text_size(text).x, max.y + axes.lanes_px + px(4)}, text, theme::dim);
  }
  small_text(list, {max.x + px(14), max.y + axes.lanes_px + px(4)}, "ms", theme::dim);
}

/// A lane for each shutter below the plot, and the dead windows over both.
void TimePane::draw_shutters(const SweepAxes& axes) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float top = axes.plot.min.y + axes.plot.size.y + px(8), lane = px(13);
  const std::array<const char*, 2> names{"left", "right"};
  for (const Side side : both_sides) {
    const ShutterTimes& times = axes.schedule->shutter[side];
    const float y = top + static_cast<float>(index_of(side)) * (lane + px(4));
    const std::uint32_t colour = side == Side::left ? left_colour : right_colour;
    list.AddRectFilled({axes.plot.min.x, y}, {axes.plot.min.x + axes.plot.size.x, y + lane}, theme::bar);
    const auto bar = [&](double from_s, double to_s) {
      list.AddRectFilled({axes.x(from_s), y}, {axes.x(to_s), y + lane}, theme::with_alpha(colour, 0.75));
    };
    if (times.open_s <= times.close_s) {
      bar(times.open_s, times.close_s);
    } else {
      bar(0.0, times.close_s);
      bar(times.open_s, axes.period_s);
    }
    small_text(list, {axes.plot.min.x + axes.plot.size.x + px(6), y}, names[index_of(side)], colour);
  }
}

void TimePane::draw_slots(const SweepAxes& axes) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float bottom = axes.plot.min.y + axes.plot.size.y;
  for (const Slot& slot : axes.schedule->slots) {
    const std::uint32_t colour = slot.eye == Side::left ? left_colour : right_colour;
    const float from = axes.x(slot.start_s), to = std::max(axes.x(slot.start_s + slot.exposure_s), from + 1.0f);
    list.AddRectFilled({from, axes.plot.min.y}, {to, bottom}, theme::with_alpha(colour, 0.16));
    const double half_d = 0.5 * std::max(slot.smear_d, 0.0);
    list.AddRectFilled({from, axes.y(slot.power_d + half_d) - px(1)}, {to, axes.y(slot.power_d - half_d) + px(1)},
                       theme::with_alpha(colour, 0.95));
    const float trigger = axes.x(slot.trigger_s < 0.0 ? slot.trigger_s + axes.period_s : slot.trigger_s);
    list.AddTriangleFilled({trigger - px(3), bottom + px(6)}, {trigger + px(3), bottom + px(6)}, {trigger, bottom},
                           theme::text);
  }
}

/// Each slice's power as a line across with a handle at its right end.
void TimePane::drag_slices(Session& session, const SweepAxes& axes) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const std::vector<double> powers_d = session.project().slices.powers_d;
  const float end = axes.plot.min.x + axes.plot.size.x;
  bool any_active = false;
  for (std::size_t i = 0; i < powers_d.size(); ++i) {
    const std::uint32_t colour = packed(slice_colour(powers_d, i));
    const float y = axes.y(powers_d[i]);
    const std::string label = signed_text(powers_d[i], 2);
    const glm::vec2 grip_min(end + px(4), y - px(8)), grip(px(56), px(16));
    ImGui::SetCursorScreenPos(to_im(grip_min));
    const std::string name = "slice " + std::to_string(i);
    ImGui::InvisibleButton(name.c_str(), to_im(grip));
    see_last_item(name);
    const bool active = ImGui::IsItemActive(), hovered = ImGui::IsItemHovered();
    if (active || hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
    if (hovered && !active) tip_for_last_item({"Drag to change this slice's power", {}, {}});
    if (active && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 1.0f)) {
      Value args;
      args.set("index", static_cast<double>(i));
      args.set("power_d", std::round(axes.power_d(ImGui::GetIO().MousePos.y) * 100.0) / 100.0);
      args.set("dragging", true);
      (void)session.run("slice.set", args);
      held_slice_ = i;
    }
    any_active = any_active || active;
    list.AddLine({axes.plot.min.x, y}, {end, y}, theme::with_alpha(colour, active || hovered ? 0.9 : 0.35));
    list.AddTriangleFilled({end + px(2), y}, {end + px(8), y - px(4)}, {end + px(8), y + px(4)}, colour);
    small_text(list, {end + px(12), y - 0.5f * small_text_size(label).y}, label,
               active || hovered ? theme::text : colour);
  }
  if (held_slice_ && !any_active) {
    held_slice_.reset();
    session.end_drag();
  }
}

void TimePane::draw_solve(Session& session, const PaneRect& rect) const {
  const Command& command = *command_named("solve.start");
  const std::string unavailable = command.unavailable(session);
  ButtonStyle style;
  style.icon = command.icon;
  style.tip = {command.help, command.shortcut, unavailable};
  if (Chips(rect, Chips::Corner::top_left).button("Solve", "Solve", style)) (void)session.run(command.id);
}

/// A press in the plot chooses the moment that all views follow; a double-click lets go of it.
void TimePane::scrub(Session& session, const SweepAxes& axes) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImGui::SetCursorScreenPos(to_im(axes.plot.min));
  ImGui::InvisibleButton("plot", {axes.plot.size.x, axes.plot.size.y + axes.lanes_px});
  ImGui::SetItemAllowOverlap();
  see_last_item("plot");
  if (ImGui::IsItemActive()) {
    Value args;
    args.set("time_s", std::clamp(axes.time_s(ImGui::GetIO().MousePos.x), 0.0, axes.period_s));
    (void)session.run("sweep.scrub", args);
    for (const Slot& slot : axes.schedule->slots) {
      const double at_s = *session.view().sweep_time_s;
      if (at_s < slot.start_s || at_s > slot.start_s + slot.exposure_s || slot.image < 0) continue;
      session.view().image = slot.image;
      session.view().side = slot.eye;
    }
  }
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) session.view().sweep_time_s.reset();
  if (!session.view().sweep_time_s) return;
  const float x = axes.x(*session.view().sweep_time_s);
  list.AddLine({x, axes.plot.min.y}, {x, axes.plot.min.y + axes.plot.size.y + axes.lanes_px}, theme::accent, px(1.5f));
  Chips chips({{axes.plot.min.x, axes.plot.min.y - px(36)}, axes.plot.size + glm::vec2(0.0f, px(36))},
              Chips::Corner::top_right);
  ButtonStyle whole;
  whole.icon = "close";
  whole.tip = {"The whole sweep again", {}, {}};
  if (chips.button("whole sweep", fixed_text(*session.view().sweep_time_s * 1e3, 2) + " ms", whole)) {
    session.view().sweep_time_s.reset();
  }
}

void TimePane::draw_reading(const SweepAxes& axes) const {
  const glm::vec2 at = from_im(ImGui::GetIO().MousePos);
  const glm::vec2 max = axes.plot.min + axes.plot.size + glm::vec2(0.0f, axes.lanes_px);
  const bool inside = at.x >= axes.plot.min.x && at.y >= axes.plot.min.y && at.x <= max.x && at.y <= max.y;
  if (!inside || held_slice_ || !ImGui::IsWindowHovered()) return;
  const double time_s = axes.time_s(at.x), share = time_s / axes.period_s;
  const PaneTooltip tooltip;
  text_line(fixed_text(time_s * 1e3, 2) + " ms");
  text_line("lens " + signed_text(periodic_at(axes.schedule->lens_power_d[Side::left], share), 3) + " D", power_colour);
  for (const Side side : both_sides) {
    const bool open = is_open(axes.schedule->shutter[side], time_s);
    text_line(
        std::string(side == Side::left ? "left" : "right") + " shutter " + (open ? "told to open" : "told to close"),
        open ? (side == Side::left ? left_colour : right_colour) : theme::faint);
  }
  for (const Slot& slot : axes.schedule->slots) {
    if (time_s >= slot.start_s && time_s <= slot.start_s + slot.exposure_s) text_line(slot_words(slot));
  }
}

}  // namespace focalstage
