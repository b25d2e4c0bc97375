#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

namespace focalstage {

/// The colours of the window, as ImGui packs them (ABGR).
namespace theme {

constexpr std::uint32_t colour(std::uint32_t rgb, std::uint32_t alpha = 0xFF) {
  return (alpha << 24) | ((rgb & 0xFFu) << 16) | (rgb & 0xFF00u) | ((rgb >> 16) & 0xFFu);
}

constexpr std::uint32_t with_alpha(std::uint32_t packed, double alpha) {
  return (packed & 0x00FFFFFFu) | (static_cast<std::uint32_t>(alpha * 255.0 + 0.5) << 24);
}

/// As VTK and shaders want it: 0..1 each.
constexpr glm::dvec3 rgb(std::uint32_t packed) {
  return {(packed & 0xFFu) / 255.0, ((packed >> 8) & 0xFFu) / 255.0, ((packed >> 16) & 0xFFu) / 255.0};
}

inline constexpr std::uint32_t gap = colour(0x0F1012);     ///< between panes and panels
inline constexpr std::uint32_t bar = colour(0x16181B);     ///< top bar, timeline
inline constexpr std::uint32_t panel = colour(0x1B1D21);   ///< outline, properties, bottom
inline constexpr std::uint32_t raised = colour(0x212429);  ///< popups, alternate rows
inline constexpr std::uint32_t field = colour(0x2A2D33);   ///< what can be typed into or pressed
inline constexpr std::uint32_t field_hovered = colour(0x343841);
inline constexpr std::uint32_t field_active = colour(0x3D424C);
inline constexpr std::uint32_t line = colour(0x2E3138);  ///< the few lines there are
inline constexpr std::uint32_t text = colour(0xD9DCE1);
inline constexpr std::uint32_t dim = colour(0x8B929C);    ///< labels; 5:1 on panels
inline constexpr std::uint32_t faint = colour(0x565C66);  ///< what cannot be used now
inline constexpr std::uint32_t accent = colour(0x4C9AFF);
inline constexpr std::uint32_t accent_fill = colour(0x2F6BC4);  ///< below white text
inline constexpr std::uint32_t selection = colour(0x2B4A75);
inline constexpr std::uint32_t amber = colour(0xF2B34C);       ///< findings and nothing else
inline constexpr std::uint32_t red = colour(0xE5544B);         ///< conflict beyond comfort, faults
inline constexpr std::uint32_t red_fill = colour(0xB3292B);    ///< Blackout and nothing else
inline constexpr std::uint32_t green = colour(0x5CB86B);       ///< done, well
inline constexpr std::uint32_t view = colour(0x131417);        ///< behind what a pane shows
inline constexpr std::uint32_t chip = colour(0x16181B, 0xC8);  ///< translucent, over pictures
inline constexpr std::uint32_t axis_x = colour(0xE5544B);
inline constexpr std::uint32_t axis_y = colour(0x6CC24A);
inline constexpr std::uint32_t axis_z = colour(0x4C9AFF);

}  // namespace theme

/// Sets ImGui's style afresh for that content scale (1 to 3).
void apply_theme(double scale);

/// The content scale of the last `apply_theme`, and a length of the design in whole pixels of it.
double ui_scale();
float px(double design_px);

}  // namespace focalstage
