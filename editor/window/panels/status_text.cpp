#include "editor/window/panels/status_text.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "editor/window/base/fonts.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widget_registry.h"

namespace focalstage {
namespace {

constexpr double side = 6.0;
constexpr double icon_room = 24.0;
constexpr double caret_room = 16.0;

float text_width(std::string_view text) { return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x; }

}  // namespace

float status_width(const StatusText& status) {
  float width = px(2 * side) + text_width(status.text);
  if (!status.icon.empty()) width += status.text.empty() ? px(16) : px(icon_room);
  if (status.caret) width += px(caret_room);
  return std::ceil(std::max(width, status.least_width_px));
}

bool status_text(std::string_view name, const StatusText& status) {
  want_glyphs(status.text);
  const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
  const glm::vec2 size(status_width(status), ImGui::GetFrameHeight());
  ImGui::PushID(name.data(), name.data() + name.size());
  const bool pressed = ImGui::InvisibleButton("status", to_im(size));
  ImGui::PopID();
  see_last_item(name);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (status.answers && (ImGui::IsItemHovered() || ImGui::IsItemActive())) {
    list.AddRectFilled(to_im(min), to_im(min + size), ImGui::IsItemActive() ? theme::field_active : theme::field,
                       px(4));
  }
  float x = min.x + px(side);
  const float y = min.y + ImGui::GetStyle().FramePadding.y;
  if (!status.icon.empty()) {
    const std::string_view glyph = icon(status.icon);
    draw_text(list, {x, y}, status.icon_colour, glyph);
    x += px(icon_room);
  }
<<<<<<< HEAD
  draw_text(list, {x, y}, status.text_colour, status.text);
=======
<<<<<<< HEAD
  draw_text(list, {x, y}, status.text_colour, status.text);
=======
  if (!status.text.empty()) {  // ImGui would measure a null text
    list.AddText({x, y}, status.text_colour, status.text.data(), status.text.data() + status.text.size());
  }
>>>>>>> main
>>>>>>> window
  if (status.caret) {
    const std::string_view caret = icon("down");
    list.AddText(small_font(), std::round(small_font()->FontSize * 0.75f), {min.x + size.x - px(caret_room), y + px(3)},
                 theme::dim, caret.data(), caret.data() + caret.size());
  }
  tip_for_last_item(status.tip);
  return pressed && status.answers;
}

}  // namespace focalstage
