#include "editor/window/panels/timeline_ruler.h"

#include <algorithm>
#include <array>
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

constexpr double reach = 7.0;        ///< design pixels around a mark that still mean it
constexpr double label_room = 46.0;  ///< between numbers
constexpr double band = 17.0;        ///< the upper one, of numbers; marks stand in the lower

/// 1, 2, 5, 10, 20 ... frames: the first that leaves room for its number.
int label_step(double px_per_frame) {
  double step = 1.0;
  for (int k = 0; step * px_per_frame < static_cast<double>(px(label_room)) && k < 30; ++k) {
    step *= k % 3 == 1 ? 2.5 : 2.0;
  }
  return static_cast<int>(step);
}

const std::vector<Keyframe>& keys_of(const Session& session) {
  static const std::vector<Keyframe> none;
  const Placement* placement = placement_of(session.project(), session.selection().primary());
  return placement ? placement->keys : none;
}

void draw_diamond(glm::vec2 centre, float radius, std::uint32_t fill, std::uint32_t line) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 corners[4] = {{centre.x, centre.y - radius},
                             {centre.x + radius, centre.y},
                             {centre.x, centre.y + radius},
                             {centre.x - radius, centre.y}};
  list.AddConvexPolyFilled(corners, 4, fill);
  if (line != 0) list.AddPolyline(corners, 4, line, ImDrawFlags_Closed, px(1));
}

bool same_time(double a, double b) { return std::abs(a - b) < same_key_s; }

}  // namespace

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
  if (same_time(time_s, held_.time_s)) return;
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

// Pictures ------------------------------------------------------------------------------------------------------------

void TimelineRuler::draw_ticks(const Session&) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const double px_per_frame = static_cast<double>(x_of(1.0) - x_of(0.0));
  const int step = count_ > 1 ? label_step(px_per_frame) : 1;
  const int fine = px_per_frame >= static_cast<double>(px(5)) ? 1 : std::max(step / 5, 1);
  const float top = rect_.min.y + px(band);
  ImFont* font = small_font();
  for (int frame = 0; frame < count_; frame += fine) {
    const bool numbered = frame % step == 0;
    const float x = std::floor(x_of(frame));
    list.AddRectFilled({x, top - (numbered ? px(4) : px(2))}, {x + std::max(px(1), 1.0f), top},
                       numbered ? theme::dim : theme::faint);
    if (!numbered) continue;
    const std::string text = std::to_string(frame);
    const float width = font->CalcTextSizeA(font->FontSize, 1e6f, 0.0f, text.c_str()).x;
    const float left = std::clamp(x - std::floor(0.5f * width), rect_.min.x + px(2),
                                  std::max(rect_.min.x + rect_.size.x - width - px(2), rect_.min.x));
    list.AddText(font, font->FontSize, {left, rect_.min.y - px(1)}, theme::dim, text.c_str());
  }
  list.AddLine({rect_.min.x, top}, {rect_.min.x + rect_.size.x, top}, theme::line);
}

void TimelineRuler::draw_cues(const Session& session, const Mark& hovered) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const std::vector<Cue>& cues = session.project().cues;
  ImFont* font = small_font();
  const float top = rect_.min.y + px(band);
  const std::string_view flag = icon("cue");
  for (std::size_t i = 0; i < cues.size(); ++i) {
    const float x = std::floor(x_of(cues[i].time_s * rate_hz_));
    const bool lit = hovered.kind == Held::cue && hovered.cue == cues[i].name;
    const std::uint32_t colour = lit ? theme::text : theme::dim;
    list.AddRectFilled({x, top}, {x + px(1), rect_.min.y + rect_.size.y}, theme::green);
    list.AddText(font, std::round(font->FontSize * 0.8f), {x + px(2), top + px(2)}, theme::green, flag.data(),
                 flag.data() + flag.size());
    see_widget("cue " + cues[i].name, {x - px(5), top}, {x + px(5), rect_.min.y + rect_.size.y});
    float end = rect_.min.x + rect_.size.x;
    for (const Cue& other : cues) {
      const float other_x = x_of(other.time_s * rate_hz_);
      if (other_x > x + 1.0f) end = std::min(end, other_x);
    }
    for (const Keyframe& key : keys_of(session)) {
      const float key_x = x_of(key.time_s * rate_hz_) - px(8);
      if (key_x > x + px(4)) end = std::min(end, key_x);
    }
    if (end - x < px(36)) continue;
    ImGui::PushFont(font);
    const std::string name = elided(cues[i].name, end - x - px(20));
    ImGui::PopFont();
    list.AddText(font, font->FontSize, {x + px(16), top}, colour, name.c_str());
  }
}

void TimelineRuler::draw_keys(const Session& session, const Mark& hovered) const {
  const auto& chosen = session.view().key_time_s;
  const float y = std::floor(0.5f * (rect_.min.y + px(band) + rect_.min.y + rect_.size.y));
  std::size_t number = 0;
  for (const Keyframe& key : keys_of(session)) {
    const double frame = key.time_s * rate_hz_;
    see_widget("key " + std::to_string(number++), {x_of(frame) - px(5), y - px(5)}, {x_of(frame) + px(5), y + px(5)});
    if (frame > count_ - 0.5) continue;  // after the last frame
    const bool is_chosen = chosen && same_time(*chosen, key.time_s);
    const bool here = same_time(key.time_s, session.view().frame / rate_hz_);
    const bool lit = hovered.kind == Held::key && same_time(hovered.time_s, key.time_s);
    draw_diamond({x_of(frame), y}, px(lit || is_chosen ? 7 : 6),
                 is_chosen ? theme::accent
                 : lit     ? theme::colour(0xFFFFFF)
                 : here    ? theme::text
                           : theme::dim,
                 theme::panel);
  }
}

void TimelineRuler::draw_playhead(const Session& session) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float x = std::floor(x_of(session.view().frame)) + 0.5f;
  list.AddLine({x, rect_.min.y + px(4)}, {x, rect_.min.y + rect_.size.y}, theme::accent, std::max(px(1), 1.0f));
  const std::string text = std::to_string(session.view().frame);
  ImFont* font = small_font();
  const float width = font->CalcTextSizeA(font->FontSize, 1e6f, 0.0f, text.c_str()).x + px(8);
  const float left =
      std::clamp(std::floor(x - 0.5f * width), rect_.min.x, std::max(rect_.min.x + rect_.size.x - width, rect_.min.x));
  list.AddRectFilled({left, rect_.min.y}, {left + width, rect_.min.y + px(15)}, theme::accent_fill, px(3));
  list.AddText(font, font->FontSize, {left + px(4), rect_.min.y - px(1)}, theme::colour(0xFFFFFF), text.c_str());
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
