#include "editor/window/base/chips.h"

#include <string>

#include "editor/window/base/fonts.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"
#include "editor/window/base/theme.h"

namespace focalstage {
namespace {

float reserved_left_px = 0.0f;
float reserved_right_px = 0.0f;

}  // namespace

void reserve_top_corners(float left_px, float right_px) {
  reserved_left_px = left_px;
  reserved_right_px = right_px;
}

Chips::Chips(const PaneRect& rect, Corner corner)
    : rect_(rect),
      right_(corner == Corner::top_right || corner == Corner::bottom_right),
      bottom_(corner == Corner::bottom_left || corner == Corner::bottom_right) {
  if (bottom_) return;
  along_px_ = right_ ? reserved_right_px : reserved_left_px;
  other_end_px_ = right_ ? reserved_left_px : reserved_right_px;
}

bool Chips::take(glm::vec2 size, glm::vec2& min) {
  const float margin = px(8);
  const float start = along_px_ + margin;
  if (start + size.x + margin + other_end_px_ > rect_.size.x || rows_px_ + size.y + 2.0f * margin > rect_.size.y)
    return false;
  min.x = right_ ? rect_.min.x + rect_.size.x - start - size.x : rect_.min.x + start;
  min.y = bottom_ ? rect_.min.y + rect_.size.y - margin - rows_px_ - size.y : rect_.min.y + margin + rows_px_;
  along_px_ += size.x + px(5);
  return true;
}

void Chips::label(std::string_view icon_name, std::string_view text) {
  want_glyphs(text);
  std::string words(icon(icon_name));
  if (!words.empty() && !text.empty()) words += "  ";
  words += text;
  const glm::vec2 padding = from_im(ImGui::GetStyle().FramePadding);
  const glm::vec2 size = from_im(ImGui::CalcTextSize(words.c_str())) + 2.0f * padding;
  glm::vec2 min;
  if (!take(size, min)) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(to_im(min), to_im(min + size), theme::chip, px(4));
  list.AddText(to_im(min + padding), theme::text, words.c_str());
}

bool Chips::button(std::string_view name, std::string_view label, ButtonStyle style) {
  style.look = ButtonLook::chip;
  glm::vec2 min;
  if (!take(button_size(label, style), min)) return false;
  const ImVec2 cursor = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos(to_im(min));
  const bool pressed = named_button(name, label, style);
  ImGui::SetCursorScreenPos(cursor);
  return pressed;
}

void Chips::next_row() {
  along_px_ = other_end_px_ = 0.0f;
  rows_px_ += ImGui::GetFrameHeight() + px(5);
}

}  // namespace focalstage
