#include "editor/window/panels/timeline_panel.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/number_words.h"
#include "editor/session/edits.h"
#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/command_widgets.h"
#include "editor/window/panels/timeline_ruler.h"

namespace focalstage {
namespace {

constexpr double first_animation_s = 2.0;

class TimelinePanel final : public Panel {
 public:
  std::string_view name() const override { return "timeline"; }
  PanelPlace place() const override { return PanelPlace::timeline; }

  void draw(Session& session, const PaneRect& rect) override {
    if (!session.has_document()) return;
    const float middle = std::floor(rect.min.y + 0.5f * (rect.size.y - ImGui::GetFrameHeight()));
    ImGui::SetCursorScreenPos({rect.min.x + px(10), middle});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(2), 0.0f});
    if (session.project().frames.count <= 1) {
      draw_still(session);
    } else {
      draw_moving(session, rect, middle);
    }
    ImGui::PopStyleVar();
  }

 private:
  static void draw_still(Session& session) {
    ImGui::AlignTextToFramePadding();
    elided_line("One frame. Set the number of frames to animate.",
                std::max(ImGui::GetContentRegionAvail().x - px(150), px(40)), theme::dim);
    ImGui::SameLine(0.0f, px(12));
    const double rate_hz = session.project().frames.rate_hz;
    const int count = std::max(2, static_cast<int>(std::lround(first_animation_s * rate_hz)));
    ButtonStyle style;
    style.icon = "film";
    const std::string help = "Two seconds at " + fixed_text(rate_hz, 0) + " Hz. More under Frames in the outline.";
    style.tip.help = help;
    if (named_button("animate", std::to_string(count) + " frames", style)) {
      (void)session.edit("Set the number of frames", {set_edit({"frames", ""}, "count", Value(count))});
    }
  }

  void draw_moving(Session& session, const PaneRect& rect, float middle) {
    draw_transport(session);
    const float left = ImGui::GetItemRectMax().x + px(10);
    const float right = draw_counts(session, rect, middle);
    const float least = px(80);
    if (right - left < least) return;
    ruler_.draw(session, {{left, rect.min.y + px(4)}, {right - left, rect.size.y - px(8)}});
  }

  static void draw_transport(Session& session) {
    ButtonStyle style;
    style.look = ButtonLook::quiet;
    const auto add = [&](const char* command, const char* icon_name) {
      style.icon = icon_name;
      command_button(session, command, command_named(command)->title, {}, style);
      ImGui::SameLine();
    };
    add("time.first", "backward");
    add("time.previous", "previous");
    style.icon = session.view().playing ? "pause" : "play";
    command_button(session, "time.play", "Play", {}, style);
    ImGui::SameLine();
    add("time.next", "next");
    ImGui::SameLine(0.0f, px(6));
    double frame = session.view().frame;
    NumberStyle number;
    number.digits = 0;
    number.step = 0.25;
    number.least = 0.0;
    number.most = session.project().frames.count - 1.0;
    number.width_px = px(58);
    number.tip.help = "The frame in view";
    if (number_field("frame", frame, number).changed) session.view().frame = static_cast<int>(std::lround(frame));
    ImGui::SameLine(0.0f, px(6));
    add("key.add", "key");
    style.icon = "cue";
    command_button(session, "cue.add", "Add a cue", {}, style);
  }

  /// How many frames, how fast, how long, at the right end. Returns where it begins.
  static float draw_counts(Session& session, const PaneRect& rect, float middle) {
    const Frames& frames = session.project().frames;
    const float end = rect.min.x + rect.size.x - px(10);
    if (rect.size.x < px(620)) return end;
    ImGui::PushFont(small_font());
    const std::string rate = "at " + fixed_text(frames.rate_hz, frames.rate_hz == std::floor(frames.rate_hz) ? 0 : 2) +
                             " Hz,  " + fixed_text(frames.count / frames.rate_hz, 2) + " s";
    const float rate_width = ImGui::CalcTextSize(rate.c_str()).x;
    const float words_width = ImGui::CalcTextSize("frames").x;
    ImGui::PopFont();
    const float field = px(58);
    const float begin = end - rate_width - words_width - field - px(14);
    ImGui::SetCursorScreenPos({begin, middle});
    draw_count(session, field);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float y = middle + std::floor(0.5f * (ImGui::GetFrameHeight() - small_font()->FontSize));
    list.AddText(small_font(), small_font()->FontSize, {begin + field + px(7), y}, theme::dim, "frames");
    list.AddText(small_font(), small_font()->FontSize, {end - rate_width, y}, theme::dim, rate.c_str());
    return begin - px(10);
  }

  static void draw_count(Session& session, float width) {
    NumberStyle number;
    number.digits = 0;
    number.step = 0.5;
    number.least = 1.0;
    number.most = 1e6;
    number.width_px = width;
    number.tip.help = "How many frames the show has";
    double count = session.project().frames.count;
    const NumberChange change = number_field("count", count, number);
    std::vector<Edit> edits{set_edit({"frames", ""}, "count", Value(std::round(count)))};
    const char* words = "Set the number of frames";
    if (change.changed && change.finished) {
      (void)session.edit(words, std::move(edits));
    } else if (change.changed) {
      (void)session.drag(words, std::move(edits));
    } else if (change.finished) {
      session.end_drag();
    }
  }

  TimelineRuler ruler_;
};

}  // namespace

std::unique_ptr<Panel> make_timeline_panel() { return std::make_unique<TimelinePanel>(); }

}  // namespace focalstage
