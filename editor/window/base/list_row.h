#pragma once

#include <cstdint>
#include <string_view>

#include "editor/window/base/theme.h"
#include "editor/window/base/tip.h"

namespace focalstage {

struct ListRowStyle {
  std::string_view icon = {};
  std::uint32_t icon_colour = theme::dim;
  std::uint32_t text_colour = theme::text;
  std::string_view right = {};  ///< dim, at the right end: a shortcut, a count
  bool selected = false;
  float indent_px = 0.0f;
  float right_room_px = 0.0f;  ///< left free at the right for buttons drawn over it
  Tip tip = {};                ///< with `unavailable` set it is faint and answers nothing
};

struct RowPress {
  bool clicked = false;
  bool double_clicked = false;
  bool right_clicked = false;
  bool hovered = false;
};

/// A line that can be chosen, as wide as its region, known as `name`. Buttons may be drawn over it afterwards.
RowPress list_row(std::string_view name, std::string_view label, const ListRowStyle& style = {});

/// One of a row of tabs; `count` beside the label where not empty. True when pressed.
bool tab(std::string_view label, std::string_view count, bool active);

}  // namespace focalstage
