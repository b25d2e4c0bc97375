#include "editor/window/base/list_row.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "editor/window/base/fonts.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widget_registry.h"
#include "editor/window/base/widgets.h"

namespace focalstage {
namespace {

constexpr double padding = 6.0;
constexpr double icon_column = 22.0;

void draw_words(glm::vec2 min, glm::vec2 size, std::string_view label, const ListRowStyle& style, bool enabled) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float y = min.y + std::floor(0.5f * (size.y - ImGui::GetFontSize()));
  float left = min.x + px(padding) + style.indent_px;
  float right = min.x + size.x - px(padding) - style.right_room_px;
  if (!style.icon.empty()) {
    const std::string_view glyph = icon(style.icon);
    draw_text(list, {left, y}, enabled ? style.icon_colour : theme::faint, glyph);
    left += px(icon_column);
  }
  if (!style.right.empty()) {
    right -= ImGui::CalcTextSize(style.right.data(), style.right.data() + style.right.size()).x;
    draw_text(list, {right, y}, enabled ? theme::dim : theme::faint, style.right);
    right -= px(12);
  }
  const std::string shown = elided(label, right - left);
  list.AddText({left, y}, enabled ? style.text_colour : theme::faint, shown.c_str());
}

float natural_width(std::string_view label, const ListRowStyle& style) {
  const float label_width = ImGui::CalcTextSize(label.data(), label.data() + label.size()).x;
  const float right_width =
      style.right.empty() ? 0.0f
                          : px(28) + ImGui::CalcTextSize(style.right.data(), style.right.data() + style.right.size()).x;
  return label_width + right_width + style.indent_px + style.right_room_px + px(2 * padding) +
         (style.icon.empty() ? 0.0f : px(icon_column));
}

}  // namespace

RowPress list_row(std::string_view name, std::string_view label, const ListRowStyle& style) {
  want_glyphs(label);
  const bool popup = (ImGui::GetCurrentContext() != nullptr) && ImGui::GetContentRegionAvail().x < px(30);
  const float width = popup ? natural_width(label, style) : ImGui::GetContentRegionAvail().x;
  const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
  const glm::vec2 size(std::max(width, px(20)), ImGui::GetFontSize() + px(6));
  const bool enabled = style.tip.unavailable.empty();
  RowPress press;
  ImGui::PushID(name.data(), name.data() + name.size());
  const bool pressed = ImGui::InvisibleButton("row", to_im(size));
  ImGui::PopID();
  ImGui::SetItemAllowOverlap();
  see_last_item(name, enabled);
  press.hovered = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenOverlapped);
  press.clicked = pressed && enabled;
  press.double_clicked = enabled && press.hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
  press.right_clicked = enabled && press.hovered && ImGui::IsMouseReleased(ImGuiMouseButton_Right);
  tip_for_last_item(style.tip);
  if (!ImGui::IsItemVisible()) return press;
  const std::uint32_t fill = style.selected ? theme::selection : press.hovered && enabled ? theme::field : 0;
  if (fill != 0) ImGui::GetWindowDrawList()->AddRectFilled(to_im(min), to_im(min + size), fill, px(4));
  draw_words(min, size, label, style, enabled);
  return press;
}

bool tab(std::string_view label, std::string_view count, bool active) {
  const std::string text = count.empty() ? std::string(label) : std::string(label) + "  " + std::string(count);
  const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
  const glm::vec2 text_size = from_im(ImGui::CalcTextSize(text.c_str()));
  const glm::vec2 size = text_size + glm::vec2(px(18), px(8));
  ImGui::PushID(label.data(), label.data() + label.size());
  const bool pressed = ImGui::InvisibleButton("tab", to_im(size));
  ImGui::PopID();
  see_last_item(label);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const std::uint32_t fill = active ? theme::field : ImGui::IsItemHovered() ? theme::with_alpha(theme::field, 0.6) : 0;
  if (fill != 0) list.AddRectFilled(to_im(min), to_im(min + size), fill, px(4));
  const glm::vec2 at = min + glm::vec2(px(9), px(4));
  draw_text(list, to_im(at), active ? theme::text : theme::dim, label);
  if (!count.empty()) {
    const float offset = text_size.x - ImGui::CalcTextSize(count.data(), count.data() + count.size()).x;
    draw_text(list, {at.x + offset, at.y}, theme::dim, count);
  }
  return pressed;
}

}  // namespace focalstage
