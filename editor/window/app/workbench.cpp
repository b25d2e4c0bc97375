#include "editor/window/app/workbench.h"

#include <algorithm>
#include <cmath>

#include "editor/session/session.h"
#include "editor/window/app/frame_painter.h"
#include "editor/window/base/chips.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"

namespace focalstage {
namespace {

constexpr double render_budget_s = 0.02;  ///< for views beside the one under the hand
constexpr std::array<const char*, 5> splitter_names = {"splitter/outline", "splitter/properties", "splitter/bottom",
                                                       "splitter/across", "splitter/down"};
constexpr std::array<const char*, 4> view_names = {"pane/room", "pane/projector", "pane/eye", "pane/time"};
constexpr ImGuiWindowFlags fixed_window = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                          ImGuiWindowFlags_NoNav;

void place_next_window(const PaneRect& rect) {
  ImGui::SetNextWindowPos(to_im(rect.min));
  ImGui::SetNextWindowSize(to_im(rect.size));
}

glm::ivec2 size_of(const PaneRect& rect) {
  return {static_cast<int>(std::lround(rect.size.x)), static_cast<int>(std::lround(rect.size.y))};
}

std::uint32_t background_of(PanelPlace place) {
  return place == PanelPlace::bar || place == PanelPlace::timeline ? theme::bar : theme::panel;
}

}  // namespace

Workbench::Workbench(std::vector<std::unique_ptr<Panel>> panels, std::array<std::unique_ptr<Pane>, 4> panes,
                     Splits splits)
    : panels_(std::move(panels)), splits_(splits) {
  for (std::size_t i = 0; i < views_.size(); ++i) views_[i].pane = std::move(panes[i]);
}

bool Workbench::has(PanelPlace place) const {
  return std::ranges::any_of(panels_, [&](const auto& panel) { return panel->place() == place; });
}

void Workbench::draw(Session& session, const WorkbenchFrame& frame, FramePainter& painter) {
  layout_ = lay_out(frame.size_px, frame.scale, splits_, frame.filled, has(PanelPlace::timeline));
  const float bar_end = layout_.bar.min.y + layout_.bar.size.y + px(3);
  const auto size = glm::vec2(frame.size_px);
  if (frame.open) {
    draw_splitters(frame);
    render_views(session, frame, painter);
    draw_place(session, PanelPlace::outline, layout_.outline);
    draw_place(session, PanelPlace::properties, layout_.properties);
    draw_place(session, PanelPlace::timeline, layout_.timeline);
    if (layout_.bottom) draw_bottom(session, *layout_.bottom);
    for (std::size_t i = 0; i < views_.size(); ++i) draw_view(session, i, frame);
  } else {
    draw_place(session, PanelPlace::start, PaneRect{{0.0f, bar_end}, {size.x, std::max(size.y - bar_end, 1.0f)}});
  }
  draw_place(session, PanelPlace::bar, layout_.bar);
  for (const auto& panel : panels_) {
    if (panel->place() != PanelPlace::over) continue;
    const NameScope scope(panel->name());
    panel->draw(session, {{0.0f, 0.0f}, size});
  }
  unsettled_ = false;
  for (std::size_t i = 0; i < views_.size() && frame.open; ++i) unsettled_ = unsettled_ || view_is_dirty(session, i);
}

// Windows that keep their depth lie in front in the order they were first begun: splitters come first.
void Workbench::draw_splitters(const WorkbenchFrame& frame) {
  const Splits before = splits_;
  moving_.reset();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});
  for (const Splitter& splitter : layout_.splitters) {
    const char* name = splitter_names[static_cast<std::size_t>(splitter.kind)];
    const glm::vec2 reach = splitter.vertical ? glm::vec2(px(2), 0.0f) : glm::vec2(0.0f, px(2));
    const PaneRect rect{splitter.rect.min - reach, splitter.rect.size + 2.0f * reach};
    place_next_window(rect);
    if (ImGui::Begin(name, nullptr, fixed_window | ImGuiWindowFlags_NoBackground)) {
      ImGui::InvisibleButton("splitter", to_im(rect.size));
      see_last_item(name);
      const bool held = ImGui::IsItemActive();
      if (held || ImGui::IsItemHovered()) {
        ImGui::SetMouseCursor(splitter.vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
        ImGui::GetWindowDrawList()->AddRectFilled(to_im(splitter.rect.min),
                                                  to_im(splitter.rect.min + splitter.rect.size),
                                                  theme::with_alpha(theme::accent, held ? 0.9 : 0.5));
      }
      if (held) {
        moving_ = splitter.kind;
        splits_ = dragged(layout_, splits_, splitter.kind, from_im(ImGui::GetIO().MousePos), frame.scale);
      }
    }
    ImGui::End();
  }
  ImGui::PopStyleVar(2);
  if (splits_ != before) {
    layout_ = lay_out(frame.size_px, frame.scale, splits_, frame.filled, has(PanelPlace::timeline));
  }
}

bool Workbench::view_is_dirty(const Session& session, std::size_t index) const {
  const View& view = views_[index];
  if (!view.pane || !layout_.views[index]) return false;
  if (moving_ && view.rendered) return false;  // stretched until the hand lets go
  return !view.rendered || view.pane->dirty(session, size_of(*layout_.views[index]));
}

void Workbench::render_views(Session& session, const WorkbenchFrame& frame, FramePainter& painter) {
  if (!frame.render_views) return;
  const auto began = std::chrono::steady_clock::now();
  // The one under the hand first, then the others in turn, so that none starves.
  std::array<std::size_t, 4> order{};
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = (next_view_ + i) % order.size();
  std::ranges::stable_partition(order, [&](std::size_t i) { return views_[i].hovered; });
  for (const std::size_t index : order) {
    if (!view_is_dirty(session, index)) continue;
    View& view = views_[index];
    const bool first_time = !view.rendered;
    const PaneRect& rect = *layout_.views[index];
    view.pane->render(session, size_of(rect), frame.scale);
    view.rendered = true;
    painter.touch(rect.min, rect.min + rect.size);
    if (!view.hovered) next_view_ = (index + 1) % order.size();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - began;
    if (first_time || spent.count() > render_budget_s) return;
  }
}

void Workbench::draw_view(Session& session, std::size_t index, const WorkbenchFrame& frame) {
  View& view = views_[index];
  view.hovered = false;
  if (!view.pane || !layout_.views[index]) return;
  const PaneRect& rect = *layout_.views[index];
  const std::string name = view_names[index];
  place_next_window(rect);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
  // Pictures are opaque: a background below them would be drawn for nothing.
  if (ImGui::Begin(name.c_str(), nullptr,
                   fixed_window | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollWithMouse)) {
    see_widget(name, rect.min, rect.min + rect.size);
    const NameScope scope(name);
    view.hovered =
        ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem | ImGuiHoveredFlags_ChildWindows);
    const std::string title = std::string(icon(view.pane->icon())) + "  " + std::string(view.pane->title());
    const float title_width = ImGui::CalcTextSize(title.c_str()).x + 2.0f * ImGui::GetStyle().FramePadding.x;
    reserve_top_corners(title_width + px(5), button_size({}, {}).x + px(5));
    view.pane->draw(session, rect);
    reserve_top_corners(0.0f, 0.0f);
    draw_view_corners(index, rect, frame.filled.has_value());
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

void Workbench::draw_view_corners(std::size_t index, const PaneRect& rect, bool filled) {
  const Pane& pane = *views_[index].pane;
  Chips(rect, Chips::Corner::top_left).label(pane.icon(), pane.title());
  ButtonStyle style;
  style.icon = filled ? "restore-panes" : "fill";
  style.tip.help = filled ? "Show all four views again" : "Let this view fill the centre";
  if (Chips(rect, Chips::Corner::top_right).button("fill", {}, style)) fill_press_ = static_cast<int>(index);
}

void Workbench::draw_panel(Session& session, Panel& panel, const PaneRect& rect) {
  const NameScope scope(panel.name());
  panel.draw(session, rect);
}

void Workbench::draw_place(Session& session, PanelPlace place, const std::optional<PaneRect>& rect) {
  if (!rect) return;
  for (const auto& panel : panels_) {
    if (panel->place() != place) continue;
    place_next_window(*rect);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, background_of(place));
    const bool scrolls = place == PanelPlace::properties || place == PanelPlace::start;
    const ImGuiWindowFlags flags = scrolls ? fixed_window & ~ImGuiWindowFlags_NoScrollbar : fixed_window;
    const bool shown = ImGui::Begin(("panel/" + std::string(panel->name())).c_str(), nullptr, flags);
    ImGui::PopStyleColor();
    if (shown) draw_panel(session, *panel, *rect);
    ImGui::End();
    return;
  }
}

void Workbench::draw_bottom(Session& session, const PaneRect& rect) {
  place_next_window(rect);
  if (ImGui::Begin("panel/bottom", nullptr, fixed_window)) {
    Panel* shown = nullptr;
    for (const auto& panel : panels_) {
      if (panel->place() == PanelPlace::bottom && (shown == nullptr || panel->name() == session.view().bottom_tab)) {
        shown = panel.get();
      }
    }
    for (const auto& panel : panels_) {
      if (panel->place() != PanelPlace::bottom) continue;
      const NameScope scope("tabs");
      if (tab(panel->title(), panel->badge(session), panel.get() == shown)) session.view().bottom_tab = panel->name();
      ImGui::SameLine(0.0f, px(4));
    }
    ImGui::NewLine();
    const glm::vec2 size = from_im(ImGui::GetContentRegionAvail());
    if (shown != nullptr && ImGui::BeginChild("body", to_im(glm::max(size, glm::vec2(1.0f))))) {
      draw_panel(session, *shown, {from_im(ImGui::GetCursorScreenPos()), size});
    }
    if (shown != nullptr) ImGui::EndChild();
  }
  ImGui::End();
}

std::optional<int> Workbench::take_fill_press() {
  const std::optional<int> press = fill_press_;
  fill_press_.reset();
  return press;
}

void Workbench::finalize() {
  for (View& view : views_) {
    if (view.pane) view.pane->finalize();
  }
}

}  // namespace focalstage
