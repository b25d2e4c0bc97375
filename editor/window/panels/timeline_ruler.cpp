#include "editor/window/panels/timeline_ruler.h"

#include <algorithm>
#include <cmath>

#include "core/base/number_words.h"
#include "editor/session/edits.h"
#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/key_pressed.h"
#include "editor/window/panels/menu.h"

namespace focalstage {
namespace {

constexpr double reach = 7.0;  ///< design pixels around a mark that still mean it

}  // namespace

const std::vector<Keyframe>& TimelineRuler::keys_of(const Session& session) {
  static const std::vector<Keyframe> none;
  const Placement* placement = placement_of(session.project(), session.selection().primary());
  return placement ? placement->keys : none;
}

float TimelineRuler::x_of(double frame) const {
  const float inset = px(10);
  const double share = count_ > 1 ? frame / (count_ - 1) : 0.0;
  return rect_.min.x + inset + static_cast<float>(share) * std::max(rect_.size.x - 2.0f * inset, 1.0f);
}

double TimelineRuler::frame_at(float x) const {
  const float inset = px(10);
  const float share = (x - rect_.min.x - inset) / std::max(rect_.size.x - 2.0f * inset, 1.0f);
  return std::clamp(std::round(static_cast<double>(share) * (count_ - 1)), 0.0, count_ - 1.0);
}

TimelineRuler::Mark TimelineRuler::mark_at(const Session& session, glm::vec2 at) const {
  if (at.y < rect_.min.y + px(band) - px(2)) return {};
  Mark nearest;
  float off = px(reach);
  const auto consider = [&](Mark mark) {
    const float apart = std::abs(x_of(mark.time_s * rate_hz_) - at.x);
    if (apart >= off) return;
    off = apart;
    nearest = std::move(mark);
  };
  for (const Keyframe& key : keys_of(session)) consider({Held::key, key.time_s, {}});  // drawn above the cues
  for (const Cue& cue : session.project().cues) consider({Held::cue, cue.time_s, cue.name});
  return nearest;
}

void TimelineRuler::draw(Session& session, const PaneRect& rect) {
  rect_ = rect;
  count_ = std::max(session.project().frames.count, 1);
  rate_hz_ = session.project().frames.rate_hz;
  ImGui::SetCursorScreenPos(to_im(rect.min));
  ImGui::InvisibleButton("ruler", to_im(glm::max(rect.size, glm::vec2(1.0f))),
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
  see_last_item("ruler");
  const bool hovered = ImGui::IsItemHovered();
  follow_hand(session);
  const Mark under =
      hovered || held_.kind != Held::nothing ? mark_at(session, from_im(ImGui::GetIO().MousePos)) : Mark{};
  if (under.kind == Held::cue && hovered) {
    tip_for_last_item({under.cue + "  " + fixed_text(under.time_s, 3) + " s", {}, {}});
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(to_im(rect.min), to_im(rect.min + rect.size), theme::panel, px(4));
  list.PushClipRect(to_im(rect.min), to_im(rect.min + rect.size), true);
  draw_ticks(session);
  draw_cues(session, under);
  draw_keys(session, under);
  draw_playhead(session);
  list.PopClipRect();
  draw_menu(session);
  draw_rename(session);
}

// Hands ---------------------------------------------------------------------------------------------------------------

void TimelineRuler::follow_hand(Session& session) {
  const glm::vec2 at = from_im(ImGui::GetIO().MousePos);
  if (ImGui::IsItemActivated() && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    take(session, mark_at(session, at));
    held_from_x_ = at.x;
    moved_ = false;
  }
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && held_.kind == Held::cue) {
    renamed_cue_ = typed_ = held_.cue;
    open_rename_ = true;
    held_ = {};
  }
  if (ImGui::IsItemHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Right)) {
    menu_for_ = mark_at(session, at);
    take(session, menu_for_);
    held_ = {};
    ImGui::OpenPopup("timeline menu");
  }
  if (held_.kind == Held::nothing) return;
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    if (moved_) session.end_drag();
    held_ = {};
    return;
  }
  moved_ = moved_ || std::abs(at.x - held_from_x_) > px(3);
  if (held_.kind == Held::playhead || moved_) drag(session);
}

/// What is pressed becomes chosen: a key for Delete, its frame for the views.
void TimelineRuler::take(Session& session, const Mark& mark) {
  held_ = mark;
  session.view().key_time_s.reset();
  if (mark.kind == Held::nothing) {
    held_.kind = Held::playhead;
    return;
  }
  if (mark.kind == Held::key) session.view().key_time_s = mark.time_s;
  session.view().frame = static_cast<int>(std::clamp(std::round(mark.time_s * rate_hz_), 0.0, count_ - 1.0));
}

void TimelineRuler::drag(Session& session) {
  const double frame = frame_at(ImGui::GetIO().MousePos.x);
  session.view().frame = static_cast<int>(frame);
  if (held_.kind == Held::playhead) return;
  const double time_s = frame / rate_hz_;
  if (same_key(time_s, held_.time_s)) return;
  if (held_.kind == Held::key) drag_key(session, time_s);
  if (held_.kind == Held::cue) drag_cue(session, time_s);
}

/// Two keys cannot have the same moment: a dragged one passes over the others.
void TimelineRuler::drag_key(Session& session, double time_s) {
  if (has_key_at(session.project(), session.selection().primary(), time_s)) return;
  Value args;
  args.set("from_s", held_.time_s);
  args.set("to_s", time_s);
  args.set("dragging", true);
  session.view().key_time_s.reset();
  if (session.run("key.move", args)) held_.time_s = time_s;
  session.view().key_time_s = held_.time_s;
}

void TimelineRuler::drag_cue(Session& session, double time_s) {
  if (session.drag("Move cue " + held_.cue, {set_edit({"cues", held_.cue}, "time_s", Value(time_s))})) {
    held_.time_s = time_s;
  }
}

// Menus ---------------------------------------------------------------------------------------------------------------

void TimelineRuler::draw_menu(Session& session) {
  const glm::vec2 at(x_of(session.view().frame), rect_.min.y - px(150));
  if (!begin_menu("timeline menu", false, at, at, px(220))) return;
  {
    const NameScope scope("menu");
    if (menu_for_.kind == Held::cue) {
      ListRowStyle style;
      style.icon = "rename";
      if (menu_row("rename cue", "Rename cue…", style)) {
        renamed_cue_ = typed_ = menu_for_.cue;
        open_rename_ = true;
      }
      Value args;
      args.set("name", menu_for_.cue);
      command_row(session, "cue.delete", "Delete cue", args);
      menu_line();
    }
    command_row(session, "key.add");
    command_row(session, "key.delete");
    command_row(session, "cue.add");
  }
  end_menu();
}

void TimelineRuler::draw_rename(Session& session) {
  const bool first = open_rename_;
  if (open_rename_) ImGui::OpenPopup("rename cue");
  open_rename_ = false;
  const float x = std::max(px(4), std::min(ImGui::GetIO().MousePos.x, ImGui::GetIO().DisplaySize.x - px(220)));
  ImGui::SetNextWindowPos({x, rect_.min.y - px(46)}, ImGuiCond_Appearing);
  if (!ImGui::BeginPopup("rename cue", ImGuiWindowFlags_NoMove)) return;
  FieldStyle style;
  style.width_px = px(190);
  style.focus = first || ImGui::IsWindowAppearing();
  style.select_all = true;
  const TextChange change = text_field("cue name", typed_, style);
  const bool left = ImGui::IsItemDeactivated();
  if ((change.finished || left) && !key_pressed(ImGuiKey_Escape) && typed_ != renamed_cue_) {
    (void)session.edit("Rename cue " + renamed_cue_ + " to " + typed_,
                       {{Edit::Kind::rename, "cues", renamed_cue_, "", Value(typed_)}});
  }
  if (change.finished || left) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace focalstage
