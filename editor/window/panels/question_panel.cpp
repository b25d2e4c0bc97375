#include "editor/window/panels/question_panel.h"

#include <algorithm>
#include <optional>

#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/dialog.h"
#include "editor/window/panels/key_pressed.h"

namespace focalstage {
namespace {

class QuestionPanel final : public Panel {
 public:
  std::string_view name() const override { return "question"; }
  PanelPlace place() const override { return PanelPlace::over; }

  void draw(Session& session, const PaneRect& rect) override {
    if (!session.question()) return;
    const Question question = *session.question();
    if (!begin_dialog("question", rect, px(440))) return;
    ImGui::PushFont(strong_font());
    paragraph(question.title);
    ImGui::PopFont();
    if (!question.text.empty()) paragraph(question.text, theme::dim);
    ImGui::Dummy({0.0f, px(8)});
    const auto chosen = draw_choices(question);
    if (chosen) close_dialog();
    end_dialog();
    if (chosen) session.answer(*chosen);
  }

 private:
  /// Buttons from the right: the default outermost. Enter takes the first choice, Escape the last.
  static std::optional<std::size_t> draw_choices(const Question& question) {
    std::optional<std::size_t> chosen;
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    const float y = ImGui::GetCursorScreenPos().y;
    float x = right;
    for (std::size_t i = 0; i < question.choices.size(); ++i) {
      ButtonStyle style;
      if (i == 0) style.look = ButtonLook::accent;
      style.width_px = std::max(button_size(question.choices[i], {}).x + px(8), px(84));
      x -= style.width_px;
      ImGui::SetCursorScreenPos({x, y});
      if (button(question.choices[i], style)) chosen = i;
      x -= px(8);
    }
    if (ImGui::IsWindowAppearing() || question.choices.empty()) return chosen;
    const bool enter = key_pressed(ImGuiKey_Enter) || key_pressed(ImGuiKey_KeyPadEnter);
    if (enter) chosen = 0;
    if (key_pressed(ImGuiKey_Escape)) chosen = question.choices.size() - 1;
    return chosen;
  }
};

}  // namespace

std::unique_ptr<Panel> make_question_panel() { return std::make_unique<QuestionPanel>(); }

}  // namespace focalstage
