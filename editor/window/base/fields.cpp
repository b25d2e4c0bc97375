#include "editor/window/base/fields.h"

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "editor/window/base/fonts.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"
#include "editor/window/base/list_row.h"
#include "editor/window/base/number_text.h"
#include "editor/window/base/theme.h"
#include "editor/window/base/widget_registry.h"

namespace focalstage {
namespace {

std::string hidden_label(std::string_view name) { return "##" + std::string(name); }

float width_of(const FieldStyle& style) { return style.width_px > 0.0f ? style.width_px : ImGui::CalcItemWidth(); }

void begin_enabled(const FieldStyle& style) {
  if (!style.tip.unavailable.empty()) ImGui::BeginDisabled();
}

void end_enabled(std::string_view name, const FieldStyle& style) {
  const bool enabled = style.tip.unavailable.empty();
  if (!enabled) ImGui::EndDisabled();
  see_last_item(name, enabled);
  tip_for_last_item(style.tip);
}

bool combo_items(int& index, std::span<const std::string> items) {
  bool chosen = false;
  for (std::size_t i = 0; i < items.size(); ++i) {
    ListRowStyle row;
    row.selected = index == static_cast<int>(i);
    if (list_row(items[i], items[i], row).clicked) {
      chosen = index != static_cast<int>(i);
      index = static_cast<int>(i);
      ImGui::CloseCurrentPopup();
    }
  }
  return chosen;
}

/// The closed combo: its value left, a caret right.
bool combo_face(std::string_view name, std::string_view shown, const FieldStyle& style) {
  const ImVec2 min = ImGui::GetCursorScreenPos();
  const ImVec2 size(width_of(style), ImGui::GetFrameHeight());
  const ImVec2 max(min.x + size.x, min.y + size.y);
  begin_enabled(style);
  const bool pressed = ImGui::InvisibleButton(hidden_label(name).c_str(), size);
  const bool lit = ImGui::IsItemHovered() && style.tip.unavailable.empty();
  end_enabled(name, style);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(min, max, lit ? theme::field_hovered : theme::field, px(4));
  const float caret_x = max.x - px(18);
  const float text_y = min.y + ImGui::GetStyle().FramePadding.y;
  list.PushClipRect(min, {caret_x, max.y}, true);
  const std::uint32_t colour = style.tip.unavailable.empty() ? theme::text : theme::dim;
  draw_text(list, {min.x + ImGui::GetStyle().FramePadding.x, text_y}, colour, shown);
  list.PopClipRect();
  const std::string_view caret = icon("unfolded");
  draw_text(list, *small_font(), {caret_x, text_y + px(1)}, theme::dim, caret);
  return pressed;
}

}  // namespace

TextChange text_field(std::string_view name, std::string& text, const FieldStyle& style) {
  want_glyphs(text);
  ImGui::SetNextItemWidth(width_of(style));
  if (style.focus) ImGui::SetKeyboardFocusHere();
  begin_enabled(style);
  const std::string hint = style.mixed ? "—" : std::string(style.hint);
  ImGui::PushStyleColor(ImGuiCol_TextDisabled, theme::dim);
  TextChange change;
  const ImGuiInputTextFlags flags = style.select_all ? ImGuiInputTextFlags_AutoSelectAll : ImGuiInputTextFlags_None;
  change.changed = ImGui::InputTextWithHint(hidden_label(name).c_str(), hint.c_str(), &text, flags);
  ImGui::PopStyleColor();
  const bool left = ImGui::IsItemDeactivated();
  change.entered = left && (ImGui::IsKeyPressedMap(ImGuiKey_Enter) || ImGui::IsKeyPressedMap(ImGuiKey_KeyPadEnter));
  change.finished = change.entered || ImGui::IsItemDeactivatedAfterEdit();
  end_enabled(name, style);
  return change;
}

bool combo(std::string_view name, int& index, std::span<const std::string> items, const FieldStyle& style) {
  const bool known = index >= 0 && index < static_cast<int>(items.size()) && !style.mixed;
  const std::string shown = known ? items[static_cast<std::size_t>(index)] : "—";
  want_glyphs(shown);
  const std::string popup = "combo/" + std::string(name);
  const ImVec2 min = ImGui::GetCursorScreenPos();
  const float width = width_of(style);
  if (combo_face(name, shown, style)) ImGui::OpenPopup(popup.c_str());
  if (!ImGui::IsPopupOpen(popup.c_str())) return false;
  ImGui::SetNextWindowPos({min.x, min.y + ImGui::GetFrameHeight() + px(3)});
  ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {std::max(width, px(360)), px(320)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(5), px(5)});
  bool chosen = false;
  if (ImGui::BeginPopup(popup.c_str(), ImGuiWindowFlags_NoMove)) {
    const NameScope scope(name);
    chosen = combo_items(index, items);
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar();
  return chosen;
}

bool check(std::string_view name, bool& on, const FieldStyle& style) {
  begin_enabled(style);
  ImGui::PushItemFlag(ImGuiItemFlags_MixedValue, style.mixed);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {px(3), px(3)});
  const bool switched = ImGui::Checkbox(hidden_label(name).c_str(), &on);
  ImGui::PopStyleVar();
  ImGui::PopItemFlag();
  end_enabled(name, style);
  return switched;
}

bool slider(std::string_view name, double& value, double least, double most, int digits, std::string_view unit,
            const FieldStyle& style) {
  const ImVec2 min = ImGui::GetCursorScreenPos();
  const ImVec2 size(width_of(style), ImGui::GetFrameHeight());
  const ImVec2 max(min.x + size.x, min.y + size.y);
  begin_enabled(style);
  ImGui::InvisibleButton(hidden_label(name).c_str(), size);
  const bool held = ImGui::IsItemActive();
  const bool lit = held || ImGui::IsItemHovered();
  end_enabled(name, style);
  const double before = value;
  if (held && size.x > 2.0f && most > least) {
    const double share = std::clamp(static_cast<double>((ImGui::GetIO().MousePos.x - min.x) / size.x), 0.0, 1.0);
    const double grain = std::pow(10.0, digits);
    value = std::clamp(std::round((least + share * (most - least)) * grain) / grain, least, most);
  }
  const double share = most > least ? std::clamp((value - least) / (most - least), 0.0, 1.0) : 0.0;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(min, max, lit ? theme::field_hovered : theme::field, px(4));
  const float filled_x = min.x + std::round(static_cast<float>(share) * size.x);
  list.PushClipRect(min, {filled_x, max.y}, true);
  list.AddRectFilled(min, max, held ? theme::accent_fill : theme::selection, px(4));
  list.PopClipRect();
  const std::string number = number_text(value, digits, unit);
  ImGui::RenderTextClipped(min, max, number.c_str(), nullptr, nullptr, {0.5f, 0.5f});
  return value != before;
}

}  // namespace focalstage
