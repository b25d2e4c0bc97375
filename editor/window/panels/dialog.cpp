#include "editor/window/panels/dialog.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "editor/window/base/frame_wish.h"
#include "editor/window/base/im.h"
#include "editor/window/base/theme.h"

namespace focalstage {

bool begin_dialog(const char* id, const PaneRect& window, float width_px, float height_px) {
  if (!ImGui::IsPopupOpen(id)) ImGui::OpenPopup(id);
  const float wide = std::min(width_px, window.size.x - px(16));
  const float high = height_px > 0.0f ? std::min(height_px, window.size.y - px(16)) : 0.0f;
  const glm::vec2 middle = glm::floor(window.min + 0.5f * window.size);
  ImGui::SetNextWindowPos({middle.x, middle.y}, ImGuiCond_Always, {0.5f, 0.5f});
  if (high > 0.0f) {
    ImGui::SetNextWindowSize({wide, high});
  } else {
    ImGui::SetNextWindowSizeConstraints({wide, 0.0f}, {wide, window.size.y - px(16)});
  }
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(18), px(16)});
  const ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                 ImGuiWindowFlags_NoSavedSettings |
                                 (high > 0.0f ? ImGuiWindowFlags_None : ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, px(8));
  const bool open = ImGui::BeginPopupModal(id, nullptr, flags);
  ImGui::PopStyleVar(2);
  // The rest darkens over a few frames.
  if (open && ImGui::GetCurrentContext()->DimBgRatio < 1.0f) want_frame_within(1.0 / 60.0);
  return open;
}

void end_dialog() { ImGui::EndPopup(); }

void close_dialog() { ImGui::CloseCurrentPopup(); }

}  // namespace focalstage
