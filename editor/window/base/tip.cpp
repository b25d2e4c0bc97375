#include "editor/window/base/tip.h"

#include <imgui.h>
#include <imgui_internal.h>

#include "editor/window/base/fonts.h"
#include "editor/window/base/frame_wish.h"
#include "editor/window/base/theme.h"

namespace focalstage {
namespace {

constexpr float rest_s = 0.45f;

void words(std::string_view text, std::uint32_t colour) {
  if (text.empty()) text = "";
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopStyleColor();
}

void show(const Tip& tip) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(10), px(7)});
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(px(320));
  words(tip.help, theme::text);
  ImGui::PopTextWrapPos();
  if (!tip.shortcut.empty()) {
    ImGui::SameLine(0.0f, px(14));
    words(tip.shortcut, theme::dim);
  }
  if (!tip.unavailable.empty()) {
    ImGui::PushFont(small_font());
    ImGui::PushTextWrapPos(px(320));
    words(tip.unavailable, theme::dim);
    ImGui::PopTextWrapPos();
    ImGui::PopFont();
  }
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

}  // namespace

void tip_for_last_item(const Tip& tip) {
  if (tip.help.empty() && tip.unavailable.empty()) return;
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || ImGui::IsAnyMouseDown()) return;
  const float rested_s = ImGui::GetCurrentContext()->HoveredIdTimer;
  if (rested_s < rest_s) {
    want_frame_within(static_cast<double>(rest_s - rested_s) + 0.01);
    return;
  }
  show(tip);
}

}  // namespace focalstage
