#include "editor/window/panels/history_panel.h"

#include <string>

#include "editor/session/session.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"

namespace focalstage {
namespace {

class HistoryPanel final : public Panel {
 public:
  std::string_view name() const override { return "history"; }
  PanelPlace place() const override { return PanelPlace::bottom; }
  std::string_view title() const override { return "History"; }

  std::string badge(const Session& session) const override {
    if (!session.has_document() || session.document().history().steps().empty()) return {};
    return std::to_string(session.document().history().place());
  }

  void draw(Session& session, const PaneRect&) override {
    if (!session.has_document()) return;
    const History& history = session.document().history();
    const std::size_t place = history.place();
    const int count = static_cast<int>(history.steps().size()) + 1;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(8), px(1)});
    const float row = ImGui::GetFontSize() + px(7);
    reveal(place, row);
    int pressed = -1;
    ImGuiListClipper clipper;  // thousands of steps cost what is seen of them
    clipper.Begin(count, row);
    while (clipper.Step()) {
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
        if (draw_step(session.document(), static_cast<std::size_t>(i), place)) pressed = i;
      }
    }
    clipper.End();
    ImGui::PopStyleVar();
    if (pressed < 0 || static_cast<std::size_t>(pressed) == place) return;
    Value args;
    args.set("place", pressed);
    (void)session.run("edit.jump", args);
  }

 private:
  /// Scrolls to where the project stands when that changed, as little as shows it.
  void reveal(std::size_t place, float row) {
    if (place == shown_place_) return;
    shown_place_ = place;
    const float top = static_cast<float>(place) * row;
    const float height = ImGui::GetWindowHeight();
    const float scroll = ImGui::GetScrollY();
    if (top < scroll) ImGui::SetScrollY(top);
    if (top + 2.0f * row > scroll + height) ImGui::SetScrollY(top + 2.0f * row - height);
  }

  static bool draw_step(const Document& document, std::size_t index, std::size_t place) {
    const auto& steps = document.history().steps();
    const std::string opened = document.untitled() ? "New project" : "Opened";
    const std::string& words = index == 0 ? opened : steps[index - 1].words;
    const std::string number = std::to_string(index);
    ListRowStyle style;
    style.selected = index == place;
    style.icon = index == 0 ? "file" : index > place ? "redo" : "dot";
    style.icon_colour = index > place ? theme::faint : theme::dim;
    style.text_colour = index > place ? theme::dim : theme::text;
    style.right = number;
    if (index == place) style.tip.help = words;
    return list_row("step " + number, words, style).clicked;
  }

  std::size_t shown_place_ = 0;
};

}  // namespace

std::unique_ptr<Panel> make_history_panel() { return std::make_unique<HistoryPanel>(); }

}  // namespace focalstage
