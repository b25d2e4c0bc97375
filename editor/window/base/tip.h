#pragma once

#include <string_view>

namespace focalstage {

/// What a tooltip says.
struct Tip {
  std::string_view help = {};
  std::string_view shortcut = {};
  std::string_view unavailable = {};  ///< why it cannot be done now
};

/// Shows the tip once the hand has rested on ImGui's last item.
void tip_for_last_item(const Tip& tip);

}  // namespace focalstage
