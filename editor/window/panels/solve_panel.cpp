#include "editor/window/panels/solve_panel.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/command_widgets.h"

namespace focalstage {
namespace {

std::string sentence(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

class SolvePanel final : public Panel {
 public:
  std::string_view name() const override { return "solve"; }
  PanelPlace place() const override { return PanelPlace::over; }

  void draw(Session& session, const PaneRect& rect) override {
    const auto offer = session.solve_offer();
    if (!offer || rect.size.x < px(320) || rect.size.y < px(260)) return;
    const float width = std::min(px(520), rect.size.x - px(32));
    ImGui::SetNextWindowPos({rect.min.x + px(16), rect.min.y + rect.size.y - px(16)}, ImGuiCond_Always, {0.0f, 1.0f});
    ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, rect.size.y - px(80)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(16), px(12)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, px(8));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::field);
    const ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize;
    if (ImGui::Begin("solve", nullptr, flags)) draw_inside(session, *offer);
    see_widget("card", from_im(ImGui::GetWindowPos()),
               from_im(ImGui::GetWindowPos()) + from_im(ImGui::GetWindowSize()));
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
  }

 private:
  static void draw_inside(Session& session, const SolveOffer& offer) {
    ImGui::PushFont(strong_font());
    paragraph(offer.solved() ? "A solution for all frames" : "No sweep and slices keep all limits");
    ImGui::PopFont();
    for (const std::string& line : offer.words) {
      want_glyphs(line);
      paragraph(sentence(line), theme::dim);
    }
    ImGui::Dummy({0.0f, px(4)});
    if (!offer.solved()) draw_nearest(session, offer);
    draw_buttons(session, offer);
  }

  /// Settings that can be had instead: each a button.
  static void draw_nearest(Session& session, const SolveOffer& offer) {
    for (std::size_t i = 0; i < offer.report.nearest.size(); ++i) {
      const std::string words = sentence(offer.report.nearest[i].words);
      ButtonStyle style;
      style.icon = "remedy";
      style.tip.help = "Apply: " + words;
      const std::string label = elided(words, ImGui::GetContentRegionAvail().x - px(44));
      if (!named_button("nearest " + std::to_string(i), label, style)) continue;
      Value args;
      args.set("nearest", static_cast<double>(i));
      (void)session.run("solve.apply", args);
      return;
    }
  }

  /// From the right: the default outermost.
  static void draw_buttons(Session& session, const SolveOffer& offer) {
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    const float y = ImGui::GetCursorScreenPos().y;
    float x = right;
    const auto place = [&](std::string_view id, std::string_view label, ButtonLook look) {
      ButtonStyle style;
      style.look = look;
      style.width_px = std::max(button_size(label, {}).x + px(8), px(84));
      x -= style.width_px;
      ImGui::SetCursorScreenPos({x, y});
      (void)command_button(session, id, label, label, style);
      x -= px(8);
    };
    const bool changes = offer.solved() && !offer.report.edits.empty();
    if (changes) place("solve.apply", "Apply", ButtonLook::accent);
    place("solve.discard", changes ? "Discard" : "Close", ButtonLook::plain);
  }
};

}  // namespace

std::unique_ptr<Panel> make_solve_panel() { return std::make_unique<SolvePanel>(); }

}  // namespace focalstage
