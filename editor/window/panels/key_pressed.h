#pragma once

#include "editor/window/base/im.h"

namespace focalstage {

/// Whether the key went down in this frame, or repeats while it is held.
inline bool key_pressed(ImGuiKey key, bool repeat = false) {
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeat);
}

}  // namespace focalstage
