#include "editor/window/base/button.h"

#include <string>

#include "editor/window/base/fonts.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"
#include "editor/window/base/theme.h"
#include "editor/window/base/widget_registry.h"

namespace focalstage {
namespace {

struct Fill {
  std::uint32_t rest;
  std::uint32_t hovered;
  std::uint32_t active;
  std::uint32_t text;
};

Fill fill_of(const ButtonStyle& style) {
  switch (style.look) {
    case ButtonLook::quiet:
      return {0, theme::field, theme::field_active, theme::text};
    case ButtonLook::accent:
      return {theme::accent_fill, theme::colour(0x3A7ADB), theme::colour(0x285CA9), theme::colour(0xFFFFFF)};
    case ButtonLook::danger:
      return {theme::red_fill, theme::colour(0xCB3537), theme::colour(0x95201F), theme::colour(0xFFFFFF)};
    case ButtonLook::chip:
      return {theme::chip, theme::with_alpha(theme::field_hovered, 0.92), theme::field_active, theme::text};
    case ButtonLook::plain:
      break;
  }
  return {theme::field, theme::field_hovered, theme::field_active, theme::text};
}

std::uint32_t background(const ButtonStyle& style, bool enabled, bool hovered, bool held) {
  const Fill fill = fill_of(style);
  if (!enabled) return style.look == ButtonLook::quiet || style.look == ButtonLook::chip ? fill.rest : theme::field;
  if (held) return fill.active;
  if (style.down) return hovered ? theme::with_alpha(theme::accent_fill, 0.85) : theme::selection;
  return hovered ? fill.hovered : fill.rest;
}

std::string face(std::string_view label, const ButtonStyle& style) {
  std::string text(icon(style.icon));
  if (!text.empty() && !label.empty()) text += ' ';
  return text += label;
}

bool press(std::string_view name, std::string_view label, const ButtonStyle& style) {
  want_glyphs(label);
  const glm::vec2 size = button_size(label, style);
  const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
  const bool enabled = style.tip.unavailable.empty();
  ImGui::PushID(name.data(), name.data() + name.size());
  const bool pressed = ImGui::InvisibleButton("button", to_im(size)) && enabled;
  ImGui::PopID();
  see_last_item(name, enabled);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const std::uint32_t fill = background(style, enabled, ImGui::IsItemHovered(), ImGui::IsItemActive());
  if ((fill >> 24) != 0) list.AddRectFilled(to_im(min), to_im(min + size), fill, px(4));
  const std::string text = face(label, style);
  const glm::vec2 text_size = from_im(ImGui::CalcTextSize(text.c_str()));
  const glm::vec2 at = glm::floor(min + 0.5f * (size - text_size));
  list.AddText(to_im(at), enabled ? fill_of(style).text : theme::faint, text.c_str());
  tip_for_last_item(style.tip);
  return pressed;
}

}  // namespace

glm::vec2 button_size(std::string_view label, const ButtonStyle& style) {
  const std::string text = face(label, style);
  const float height = ImGui::GetFrameHeight();
  const float text_width = ImGui::CalcTextSize(text.c_str()).x;
  const float natural = label.empty() ? height + px(4) : text_width + 2.0f * ImGui::GetStyle().FramePadding.x;
  return {style.width_px > 0.0f ? style.width_px : natural, height};
}

bool button(std::string_view label, const ButtonStyle& style) { return press(label, label, style); }

bool icon_button(std::string_view name, const ButtonStyle& style) { return press(name, {}, style); }

bool named_button(std::string_view name, std::string_view label, const ButtonStyle& style) {
  return press(name, label, style);
}

}  // namespace focalstage
