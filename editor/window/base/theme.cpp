#include "editor/window/base/theme.h"

#include <cmath>

#include "editor/window/base/im.h"

namespace focalstage {
namespace {

double current_scale = 1.0;

void set(ImGuiStyle& style, ImGuiCol which, std::uint32_t packed) {
  style.Colors[which] = ImGui::ColorConvertU32ToFloat4(packed);
}

void set_colours(ImGuiStyle& style) {
  constexpr std::uint32_t clear = 0;
  set(style, ImGuiCol_Text, theme::text);
  set(style, ImGuiCol_TextDisabled, theme::faint);
  set(style, ImGuiCol_WindowBg, theme::panel);
  set(style, ImGuiCol_ChildBg, clear);
  set(style, ImGuiCol_PopupBg, theme::raised);
  set(style, ImGuiCol_Border, theme::line);
  set(style, ImGuiCol_FrameBg, theme::field);
  set(style, ImGuiCol_FrameBgHovered, theme::field_hovered);
  set(style, ImGuiCol_FrameBgActive, theme::field_active);
  set(style, ImGuiCol_ScrollbarBg, clear);
  set(style, ImGuiCol_ScrollbarGrab, theme::field_hovered);
  set(style, ImGuiCol_ScrollbarGrabHovered, theme::field_active);
  set(style, ImGuiCol_ScrollbarGrabActive, theme::faint);
  set(style, ImGuiCol_CheckMark, theme::accent);
  set(style, ImGuiCol_SliderGrab, theme::accent);
  set(style, ImGuiCol_SliderGrabActive, theme::accent);
  set(style, ImGuiCol_Button, theme::field);
  set(style, ImGuiCol_ButtonHovered, theme::field_hovered);
  set(style, ImGuiCol_ButtonActive, theme::field_active);
  set(style, ImGuiCol_Header, theme::selection);
  set(style, ImGuiCol_HeaderHovered, theme::field);
  set(style, ImGuiCol_HeaderActive, theme::selection);
  set(style, ImGuiCol_Separator, theme::line);
  set(style, ImGuiCol_Tab, clear);
  set(style, ImGuiCol_TabHovered, theme::field_hovered);
  set(style, ImGuiCol_TabActive, theme::field);
  set(style, ImGuiCol_TextSelectedBg, theme::selection);
  set(style, ImGuiCol_TableRowBgAlt, theme::with_alpha(theme::field, 0.25));
  set(style, ImGuiCol_NavHighlight, theme::accent);
  set(style, ImGuiCol_PlotHistogram, theme::accent);
  set(style, ImGuiCol_DragDropTarget, theme::accent);
  set(style, ImGuiCol_ModalWindowDimBg, theme::with_alpha(theme::gap, 0.6));
}

void set_sizes(ImGuiStyle& style) {
  style.WindowBorderSize = style.ChildBorderSize = style.FrameBorderSize = style.TabBorderSize = 0.0f;
  style.PopupBorderSize = 1.0f;
  style.WindowRounding = style.ChildRounding = 0.0f;
  style.FrameRounding = style.GrabRounding = style.TabRounding = 4.0f;
  style.PopupRounding = 6.0f;
  style.ScrollbarRounding = 6.0f;
  style.ScrollbarSize = 11.0f;
  style.WindowPadding = {10.0f, 8.0f};
  style.FramePadding = {8.0f, 4.0f};
  style.ItemSpacing = {8.0f, 6.0f};
  style.ItemInnerSpacing = {6.0f, 4.0f};
  style.CellPadding = {6.0f, 3.0f};
  style.IndentSpacing = 16.0f;
  style.GrabMinSize = 10.0f;
  style.WindowMinSize = {8.0f, 8.0f};
}

}  // namespace

void apply_theme(double scale) {
  current_scale = scale;
  ImGuiStyle style;  // afresh: ScaleAllSizes multiplies what is there
  set_colours(style);
  set_sizes(style);
  style.ScaleAllSizes(static_cast<float>(scale));
  ImGui::GetStyle() = style;
}

double ui_scale() { return current_scale; }

float px(double design_px) { return static_cast<float>(std::round(design_px * current_scale)); }

}  // namespace focalstage
