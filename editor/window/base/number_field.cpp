#include "editor/window/base/number_field.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "editor/window/base/frame_wish.h"
#include "editor/window/base/number_text.h"
#include "editor/window/base/theme.h"
#include "editor/window/base/widget_registry.h"

namespace focalstage {
namespace {

// One field at a time is typed into or dragged, as one hand does.
struct Hand {
  ImGuiID typing = 0;
  int typing_frame = 0;  ///< the last one in which the field was there
  bool fresh = false;    ///< the text input has not taken the keyboard yet
  std::array<char, 64> text{};
  ImGuiID dragging = 0;
  double start = 0.0;
  double moved = 0.0;  ///< pixels, weighed by Shift and Ctrl
};

Hand hand;

double rounded(double value, int digits) {
  const double unit = std::pow(10.0, digits);
  return std::round(value * unit) / unit;
}

void begin_typing(ImGuiID id, double value, const NumberStyle& style) {
  hand.typing = id;
  hand.typing_frame = ImGui::GetFrameCount();
  hand.fresh = true;
  want_frame_within(0.0);
  const std::string text = style.mixed ? std::string() : number_text(value, style.digits, {});
  hand.text.fill('\0');
  text.copy(hand.text.data(), hand.text.size() - 1);
}

NumberChange take_typed(double& value, const NumberStyle& style) {
  const auto typed = typed_number(hand.text.data(), style.unit);
  if (!typed) return {};
  const double taken = std::clamp(*typed, style.least, style.most);
  const bool changed = style.mixed || taken != value;
  value = taken;
  return {changed, changed};
}

NumberChange type_into(const ImRect& box, ImGuiID id, const std::string& name, double& value,
                       const NumberStyle& style) {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  hand.typing_frame = ImGui::GetFrameCount();
  if (hand.fresh) {
    ImGui::ClearActiveID();  // the button that was pressed has the same id
    context.NavActivateId = context.NavActivateInputId = id;
  }
  hand.fresh = false;
  ImGuiInputTextFlags flags = ImGuiInputTextFlags_AutoSelectAll;
  flags |= ImGuiInputTextFlags_NoMarkEdited;
  flags |= ImGuiInputTextFlags_MergedItem;
  context.CurrentWindow->DC.CursorPos = box.Min;
  // Not TempInputText, which asserts that the field gets the keyboard at once: a key or a press in the same frame, or a
  // field out of sight, may keep it from that.
  ImGui::InputTextEx(name.c_str(), nullptr, hand.text.data(), static_cast<int>(hand.text.size()), box.GetSize(), flags);
  if (context.ActiveId == id) return {};
  hand.typing = 0;
  const bool refused = ImGui::IsKeyPressedMap(ImGuiKey_Escape);
  return refused ? NumberChange{} : take_typed(value, style);
}

/// Whether the field is being typed into. One that was away for a frame has lost its text: another thing is shown now.
bool typing_goes_on(ImGuiID id) {
  if (hand.typing != id) return false;
  if (ImGui::GetFrameCount() > hand.typing_frame + 1) hand.typing = 0;
  return hand.typing == id;
}

NumberChange drag_across(ImGuiID id, double& value, const NumberStyle& style) {
  const ImGuiIO& io = ImGui::GetIO();
  if (hand.dragging != id) {
    hand.dragging = id;
    hand.start = value;
    hand.moved = 0.0;
  }
  if (style.mixed || !ImGui::IsMouseDragging(ImGuiMouseButton_Left, px(3))) return {};
  const double weight = io.KeyShift ? 0.1 : io.KeyCtrl ? 10.0 : 1.0;
  hand.moved += static_cast<double>(io.MouseDelta.x) / ui_scale() * weight;
  const int digits = io.KeyShift ? style.digits + 1 : style.digits;
  const double wanted = std::clamp(rounded(hand.start + hand.moved * style.step, digits), style.least, style.most);
  if (wanted == value) return {};
  value = wanted;
  return {true, false};
}

void draw_field(const ImRect& box, double value, const NumberStyle& style, bool enabled, bool hovered, bool held) {
  const std::uint32_t fill = !enabled  ? theme::with_alpha(theme::field, 0.5)
                             : held    ? theme::field_active
                             : hovered ? theme::field_hovered
                                       : theme::field;
  ImGui::RenderFrame(box.Min, box.Max, fill, false, ImGui::GetStyle().FrameRounding);
  const std::string text = style.mixed ? "—" : number_text(value, style.digits, style.unit);
  ImGui::PushStyleColor(ImGuiCol_Text, enabled ? theme::text : theme::dim);
  ImGui::RenderTextClipped(box.Min, box.Max, text.c_str(), nullptr, nullptr, {0.5f, 0.5f});
  ImGui::PopStyleColor();
}

/// Not being typed into: dragged, or clicked so that typing begins.
NumberChange press_or_drag(const ImRect& box, ImGuiID id, double& value, const NumberStyle& style, bool enabled) {
  bool hovered = false;
  bool held = false;
  const bool released = ImGui::ButtonBehavior(box, id, &hovered, &held, ImGuiButtonFlags_PressedOnClickReleaseAnywhere);
  NumberChange change;
  if (enabled && held) change = drag_across(id, value, style);
  const bool dragged = hand.dragging == id && hand.moved != 0.0;
  if (hand.dragging == id && !held) {
    hand.dragging = 0;
    change.finished = dragged;
  }
  if (enabled && released && !dragged) begin_typing(id, value, style);
  if (hovered && enabled) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  draw_field(box, value, style, enabled, hovered, held);
  return change;
}

}  // namespace

NumberChange number_field(std::string_view name, double& value, const NumberStyle& style) {
  ImGuiWindow* window = ImGui::GetCurrentWindow();
  if (window->SkipItems) return {};
  const ImGuiID id = window->GetID(name.data(), name.data() + name.size());
  const float width = style.width_px > 0.0f ? style.width_px : ImGui::CalcItemWidth();
  const ImVec2 min = window->DC.CursorPos;
  const ImRect box(min, {min.x + width, min.y + ImGui::GetFrameHeight()});
  const bool enabled = style.tip.unavailable.empty();
  ImGui::ItemSize(box, ImGui::GetStyle().FramePadding.y);
  if (!ImGui::ItemAdd(box, id, &box, enabled ? ImGuiItemFlags_Inputable : ImGuiItemFlags_None)) {
    see_last_item(name, enabled);
    return {};
  }
  see_last_item(name, enabled);
  const bool tabbed_to =
      (ImGui::GetCurrentContext()->LastItemData.StatusFlags & ImGuiItemStatusFlags_FocusedByTabbing) != 0;
  if (enabled && tabbed_to) begin_typing(id, value, style);
  NumberChange change;
  if (typing_goes_on(id)) {
    change = type_into(box, id, std::string(name), value, style);
  } else {
    change = press_or_drag(box, id, value, style, enabled);
    tip_for_last_item(style.tip);
  }
  return change;
}

}  // namespace focalstage
