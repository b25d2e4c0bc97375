#pragma once

#include <string_view>

#include <glm/vec2.hpp>

#include "editor/window/base/tip.h"

namespace focalstage {

enum class ButtonLook {
  plain,   ///< a field
  quiet,   ///< nothing until hovered: toolbars
  accent,  ///< the one thing to do next
  danger,  ///< Blackout
  chip,    ///< translucent, over a picture
};

struct ButtonStyle {
  ButtonLook look = ButtonLook::plain;
  std::string_view icon = {};  ///< before the label, or alone where there is none
  bool down = false;           ///< a toggle that is on
  float width_px = 0.0f;       ///< 0: what it needs
  Tip tip = {};                ///< with `unavailable` set it cannot be pressed
};

/// A button labelled `label`, known by that name. True when pressed.
bool button(std::string_view label, const ButtonStyle& style = {});

/// A square button that shows only `style.icon`, known as `name`.
bool icon_button(std::string_view name, const ButtonStyle& style);

/// Known as `name`, labelled `label`.
bool named_button(std::string_view name, std::string_view label, const ButtonStyle& style);

/// How large it would be.
glm::vec2 button_size(std::string_view label, const ButtonStyle& style);

}  // namespace focalstage
