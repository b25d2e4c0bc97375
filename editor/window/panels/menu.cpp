#include "editor/window/panels/menu.h"

#include <algorithm>
#include <string>

#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"
#include "editor/window/base/theme.h"
#include "editor/window/base/widget_registry.h"
#include "editor/window/panels/command_widgets.h"
#include "editor/window/panels/key_pressed.h"

namespace focalstage {
namespace {

/// Rows stand close: a menu is one thing.
void push_menu_style() {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(5), px(5)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(8), px(1)});
}

void pop_menu_style() { ImGui::PopStyleVar(2); }

float row_height() { return ImGui::GetFontSize() + px(6); }

}  // namespace

bool begin_menu(const char* id, bool open, glm::vec2 min, glm::vec2 max, float width_px) {
  if (open) ImGui::OpenPopup(id);
  if (!ImGui::IsPopupOpen(id)) return false;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float x = std::clamp(min.x, px(4), std::max(window.x - width_px - px(4), px(4)));
  ImGui::SetNextWindowPos({x, max.y + px(4)});
  ImGui::SetNextWindowSizeConstraints({std::min(width_px, window.x - px(8)), 0.0f},
                                      {std::min(width_px, window.x - px(8)), window.y - max.y - px(10)});
  push_menu_style();
  if (ImGui::BeginPopup(id, ImGuiWindowFlags_NoMove)) {
    if (key_pressed(ImGuiKey_Escape)) ImGui::CloseCurrentPopup();
    return true;
  }
  pop_menu_style();
  return false;
}

void end_menu() {
  ImGui::EndPopup();
  pop_menu_style();
}

bool menu_row(std::string_view name, std::string_view label, const ListRowStyle& style) {
  const bool pressed = list_row(name, label, style).clicked;
  if (pressed) ImGui::CloseCurrentPopup();
  return pressed;
}

void command_row(Session& session, std::string_view id, std::string_view label, const Value& args) {
  const CommandFace face(session, id);
  ListRowStyle style;
  style.icon = face.command.icon.empty() ? std::string_view() : face.command.icon;
  style.right = face.command.shortcut;
  style.tip = face.tip();
  style.tip.shortcut = {};  // it stands in the row
  if (face.command.icon.empty()) style.indent_px = px(22);
  if (menu_row(id, label.empty() ? face.command.title : label, style)) (void)session.run(id, args);
}

bool begin_submenu(std::string_view label, std::string_view icon_name, float width_px) {
  const std::string id = "##" + std::string(label);
  const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
  const glm::vec2 max = min + glm::vec2(ImGui::GetContentRegionAvail().x, row_height());
  ImDrawList& list = *ImGui::GetWindowDrawList();
  see_widget(label, min, max);
  if (ImGui::IsMouseHoveringRect(to_im(min), to_im(max)) || ImGui::IsPopupOpen(id.c_str())) {
    list.AddRectFilled(to_im(min), to_im(max), theme::field, px(4));
  }
  const std::string_view glyph = icon(icon_name);
  const float y = min.y + px(3);
  list.AddText({min.x + px(6), y}, theme::dim, glyph.data(), glyph.data() + glyph.size());
  list.AddText({min.x + px(28), y}, theme::text, label.data(), label.data() + label.size());
  // ImGui's own row draws nothing but the arrow; it knows when a submenu may stay open.
  ImGui::SetCursorScreenPos({min.x, y});
  ImGui::SetNextWindowSizeConstraints({width_px, 0.0f}, {width_px, ImGui::GetIO().DisplaySize.y * 0.8f});
  for (const ImGuiCol which : {ImGuiCol_Header, ImGuiCol_HeaderHovered, ImGuiCol_HeaderActive}) {
    ImGui::PushStyleColor(which, 0);
  }
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(8), px(6)});
  ImGui::PushStyleColor(ImGuiCol_Text, theme::dim);
  const bool open = ImGui::BeginMenu(id.c_str());
  ImGui::PopStyleColor(4);
  ImGui::PopStyleVar();
  if (!open) ImGui::SetCursorScreenPos({min.x, max.y + px(1)});
  return open;
}

void end_submenu() {
  ImGui::EndMenu();
  const ImVec2 cursor = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos({cursor.x, cursor.y - px(2)});  // ImGui's row is followed by its own, larger spacing
}

void menu_line() {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::Dummy({0.0f, px(8)});
  ImGui::GetWindowDrawList()->AddLine({at.x + px(6), at.y + px(4)}, {at.x + width - px(6), at.y + px(4)}, theme::line);
}

}  // namespace focalstage
