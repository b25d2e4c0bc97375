#include "editor/window/panels/notice_panel.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/frame_wish.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"

namespace focalstage {
namespace {

constexpr double shown_s = 6.0;
constexpr double fade_s = 0.4;

struct Look {
  std::string_view icon;
  std::uint32_t colour;
};

Look look_of(LogLine::Kind kind) {
  switch (kind) {
    case LogLine::Kind::good:
      return {"check", theme::green};
    case LogLine::Kind::warning:
      return {"warning", theme::amber};
    case LogLine::Kind::fault:
      return {"error", theme::red};
    case LogLine::Kind::info:
      break;
  }
  return {"info", theme::dim};
}

class NoticePanel final : public Panel {
 public:
  std::string_view name() const override { return "notice"; }
  PanelPlace place() const override { return PanelPlace::over; }

  void draw(Session& session, const PaneRect& rect) override {
    if (!session.notice()) {
      shown_ = {};
      return;
    }
    const LogLine line = *session.notice();
    if (shown_.text != line.text || shown_.at_s != line.at_s) {
      shown_ = line;
      since_s_ = ImGui::GetTime();
    }
    const double alpha = opacity(line);
    if (alpha <= 0.0) {
      session.dismiss_notice();
      return;
    }
    if (rect.size.x < px(280) || rect.size.y < px(170)) return;  // it would lie over the bar; the log has it
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, static_cast<float>(alpha));
    if (draw_line(line, rect, alpha)) session.dismiss_notice();
    ImGui::PopStyleVar();
  }

 private:
  double opacity(const LogLine& line) const {
    if (line.kind == LogLine::Kind::fault) return 1.0;
    const double left_s = since_s_ + shown_s - ImGui::GetTime();
    if (left_s > 0.0) {
      want_frame_within(left_s + 0.01);
      return 1.0;
    }
    want_frame_within(1.0 / 60.0);
    return 1.0 + left_s / fade_s;
  }

  /// True when it was dismissed.
  static bool draw_line(const LogLine& line, const PaneRect& rect, double alpha) {
    const float most = std::min(px(620), rect.size.x - px(32));
    const float beside = px(26) + px(36);  // the icon, the cross
    const float padding = px(12);
    const float words = std::min(ImGui::CalcTextSize(line.text.c_str()).x + 1.0f, most - beside - 2.0f * padding);
    const float width = std::ceil(words + beside + 2.0f * padding);
    ImGui::SetNextWindowPos({std::floor(rect.min.x + 0.5f * (rect.size.x - width)), rect.min.y + rect.size.y - px(16)},
                            ImGuiCond_Always, {0.0f, 1.0f});
    ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, rect.size.y * 0.5f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {padding, px(8)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, px(6));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::with_alpha(theme::field, alpha));
    bool dismissed = false;
    const ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize;
    if (ImGui::Begin("notice", nullptr, flags)) dismissed = draw_inside(line, words, alpha);
    see_widget("notice", from_im(ImGui::GetWindowPos()),
               from_im(ImGui::GetWindowPos()) + from_im(ImGui::GetWindowSize()));
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
    return dismissed;
  }

  static bool draw_inside(const LogLine& line, float words, double alpha) {
    const Look look = look_of(line.kind);
    const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
    const float y = min.y + ImGui::GetStyle().FramePadding.y;
    const std::string_view glyph = icon(look.icon);
    ImGui::GetWindowDrawList()->AddText({min.x, y}, theme::with_alpha(look.colour, alpha), glyph.data(),
                                        glyph.data() + glyph.size());
    ImGui::SetCursorScreenPos({min.x + px(26), y});
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + words);
    text_line(line.text);
    ImGui::PopTextWrapPos();
    const float bottom = ImGui::GetItemRectMax().y + px(3);
    ImGui::SetCursorScreenPos({min.x + px(26) + words + px(8), min.y});
    ButtonStyle style;
    style.look = ButtonLook::quiet;
    style.icon = "close";
    style.tip.help = "Dismiss; the log keeps it";
    const bool dismissed = icon_button("dismiss", style);
    ImGui::SetCursorScreenPos({min.x, bottom});
    ImGui::Dummy({1.0f, 1.0f});
    return dismissed;
  }

  LogLine shown_;
  double since_s_ = 0.0;
};

}  // namespace

std::unique_ptr<Panel> make_notice_panel() { return std::make_unique<NoticePanel>(); }

}  // namespace focalstage
