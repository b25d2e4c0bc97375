#pragma once

#include <cstdint>
#include <string_view>

#include "editor/window/base/theme.h"
#include "editor/window/base/tip.h"

namespace focalstage {

/// Words with an icon of another colour before them: how something stands.
struct StatusText {
  std::string_view icon;
  std::uint32_t icon_colour = theme::dim;
  std::string_view text;
  std::uint32_t text_colour = theme::text;
  bool caret = false;           ///< more behind it, below
  bool answers = false;         ///< can be pressed
  float least_width_px = 0.0f;  ///< so that what follows stands still while the words change
  Tip tip;
};

float status_width(const StatusText& status);

/// Known as `name`. True when pressed.
bool status_text(std::string_view name, const StatusText& status);

}  // namespace focalstage
