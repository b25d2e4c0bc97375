#pragma once

#include <imgui.h>

#include <string_view>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace focalstage {

inline ImVec2 to_im(const glm::vec2& v) { return {v.x, v.y}; }
inline glm::vec2 from_im(const ImVec2& v) { return {v.x, v.y}; }

/// Text into a draw list. An empty view may hold no pointer at all, which ImGui would read from.
inline void draw_text(ImDrawList& list, const ImVec2& at, ImU32 colour, std::string_view text) {
  if (!text.empty()) list.AddText(at, colour, text.data(), text.data() + text.size());
}

inline void draw_text(ImDrawList& list, const ImFont& font, const ImVec2& at, ImU32 colour, std::string_view text) {
  if (!text.empty()) list.AddText(&font, font.FontSize, at, colour, text.data(), text.data() + text.size());
}

}  // namespace focalstage
