#include "editor/window/panels/log_panel.h"

#include <array>
#include <cstdio>
#include <string>

#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"

namespace focalstage {
namespace {

/// Since the editor started: "0:07", "12:40", "1:02:03".
std::string clock_words(double at_s) {
  const long seconds = static_cast<long>(at_s);
  std::array<char, 32> text{};
  if (seconds >= 3600) {
    std::snprintf(text.data(), text.size(), "%ld:%02ld:%02ld", seconds / 3600, seconds / 60 % 60, seconds % 60);
  } else {
    std::snprintf(text.data(), text.size(), "%ld:%02ld", seconds / 60, seconds % 60);
  }
  return text.data();
}

std::uint32_t colour_of(LogLine::Kind kind) {
  switch (kind) {
    case LogLine::Kind::fault:
      return theme::red;
    case LogLine::Kind::warning:
      return theme::amber;
    case LogLine::Kind::good:
    case LogLine::Kind::info:
      break;
  }
  return theme::text;
}

std::string whole_text(const Log& log) {
  std::string text;
  for (const LogLine& line : log) text += clock_words(line.at_s) + "  " + line.text + "\n";
  return text;
}

class LogPanel final : public Panel {
 public:
  std::string_view name() const override { return "log"; }
  PanelPlace place() const override { return PanelPlace::bottom; }
  std::string_view title() const override { return "Log"; }

  void draw(Session& session, const PaneRect& rect) override {
    const Log& log = session.log();
    if (log.empty()) {
      paragraph("Nothing happened yet.", theme::dim);
      return;
    }
    const float width = button_size("Copy", copy_style()).x;
    const glm::vec2 corner(rect.min.x + rect.size.x - width - px(14), rect.min.y);
    draw_lines(log, rect.size.x - width - px(28));
    ImGui::SetCursorScreenPos({corner.x, corner.y});
    if (button("Copy", copy_style())) ImGui::SetClipboardText(whole_text(log).c_str());
  }

 private:
  static ButtonStyle copy_style() {
    ButtonStyle style;
    style.icon = "copy";
    style.tip.help = "All lines, to be pasted elsewhere; a click on a line copies that one";
    return style;
  }

  void draw_lines(const Log& log, float width) {
    if (!ImGui::BeginChild("lines", {width, 0.0f})) {
      ImGui::EndChild();
      return;
    }
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(8), px(1)});
    const bool at_end = ImGui::GetScrollY() >= ImGui::GetScrollMaxY() - 1.0f;
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(log.size()), ImGui::GetFontSize() + px(7));
    while (clipper.Step()) {
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
        draw_line(log[static_cast<std::size_t>(i)], static_cast<std::size_t>(i));
      }
    }
    clipper.End();
    // It follows what is new unless somebody reads above.
    if (at_end && log.size() != shown_) ImGui::SetScrollHereY(1.0f);
    shown_ = log.size();
    ImGui::PopStyleVar();
    ImGui::EndChild();
  }

  static void draw_line(const LogLine& line, std::size_t index) {
    const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
    const float time_column = px(58);
    ListRowStyle style;
    style.indent_px = time_column;
    style.text_colour = colour_of(line.kind);
    style.tip.help = line.text;
    if (list_row("line " + std::to_string(index), line.text, style).clicked) {
      ImGui::SetClipboardText(line.text.c_str());
    }
    if (!ImGui::IsItemVisible()) return;
    const std::string time = clock_words(line.at_s);
    const float right = min.x + time_column - px(8) - ImGui::CalcTextSize(time.c_str()).x;
    ImGui::GetWindowDrawList()->AddText({right, min.y + px(3)}, theme::faint, time.c_str());
  }

  std::size_t shown_ = 0;
};

}  // namespace

std::unique_ptr<Panel> make_log_panel() { return std::make_unique<LogPanel>(); }

}  // namespace focalstage
