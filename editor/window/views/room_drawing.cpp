#include "editor/window/views/room_drawing.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "editor/window/base/fonts.h"
#include "editor/window/base/theme.h"
#include "editor/window/base/widgets.h"

namespace focalstage {
namespace {

constexpr double longest_label_px = 420.0;
// What the chips in the upper left corner take.
constexpr double toolbar_width_px = 290.0;
constexpr double toolbar_height_px = 76.0;

/// Both ends in pixels, cut at the near plane; none where all of it lies before that.
std::optional<std::pair<glm::dvec2, glm::dvec2>> ends_px(const RoomView& view, glm::dvec3 a_m, glm::dvec3 b_m) {
  const double near_m = view.near_m * 1.0001;
  const double a_depth = depth_m(view, a_m);
  const double b_depth = depth_m(view, b_m);
  if (a_depth < near_m && b_depth < near_m) return std::nullopt;
  const double share = (near_m - a_depth) / (b_depth - a_depth);
  if (a_depth < near_m) a_m = glm::mix(a_m, b_m, share);
  if (b_depth < near_m) b_m = glm::mix(a_m, b_m, share);
  const auto a = pixel_of(view, a_m);
  const auto b = pixel_of(view, b_m);
  if (!a || !b) return std::nullopt;
  return std::pair{*a, *b};
}

}  // namespace

RoomDrawing::RoomDrawing(const RoomFrame& frame) : frame_(frame), list_(*ImGui::GetWindowDrawList()) {
  const PaneRect& rect = frame.rect;
  taken_.push_back({{rect.min.x, rect.min.y}, {rect.min.x + px(toolbar_width_px), rect.min.y + px(toolbar_height_px)}});
  list_.PushClipRect({rect.min.x, rect.min.y}, {rect.min.x + rect.size.x, rect.min.y + rect.size.y}, true);
}

RoomDrawing::~RoomDrawing() { list_.PopClipRect(); }

void RoomDrawing::line(const glm::dvec3& a_m, const glm::dvec3& b_m, std::uint32_t colour, double width_px) {
  if (const auto ends = ends_px(frame_.view, a_m, b_m)) {
    list_.AddLine(frame_.on_window(ends->first), frame_.on_window(ends->second), colour,
                  static_cast<float>(width_px * frame_.scale));
  }
}

void RoomDrawing::dashes(const glm::dvec3& a_m, const glm::dvec3& b_m, std::uint32_t colour, double width_px) {
  const auto ends = ends_px(frame_.view, a_m, b_m);
  if (!ends) return;
  const double length_px = glm::length(ends->second - ends->first);
  const double dash_px = 5.0 * frame_.scale;
  const int count = static_cast<int>(std::min(length_px / (2.0 * dash_px), 400.0)) + 1;
  for (int i = 0; i < count; ++i) {
    const double from = (2.0 * i) * dash_px / std::max(length_px, 1e-9);
    const double to = std::min((2.0 * i + 1.0) * dash_px / std::max(length_px, 1e-9), 1.0);
    if (from >= 1.0) break;
    list_.AddLine(frame_.on_window(glm::mix(ends->first, ends->second, from)),
                  frame_.on_window(glm::mix(ends->first, ends->second, to)), colour,
                  static_cast<float>(width_px * frame_.scale));
  }
}

bool RoomDrawing::label(const glm::dvec2& pixel, std::string_view text, std::uint32_t colour, bool always) {
  want_glyphs(text);
  ImGui::PushFont(small_font());
  const std::string shown = elided(text, px(longest_label_px));
  const ImVec2 size = ImGui::CalcTextSize(shown.c_str());
  const ImVec2 at = frame_.on_window(pixel);
  const float pad_x = px(6);
  const float pad_y = px(2);
  const ImVec2 min{std::floor(at.x - 0.5f * size.x - pad_x), std::floor(at.y - size.y - 2.0f * pad_y)};
  const ImVec2 max{min.x + size.x + 2.0f * pad_x, min.y + size.y + 2.0f * pad_y};
  const bool free = std::ranges::none_of(taken_, [&](const Box& box) {
    return min.x < box.max.x && max.x > box.min.x && min.y < box.max.y && max.y > box.min.y;
  });
  if (free || always) {
    taken_.push_back({min, max});
    list_.AddRectFilled(min, max, theme::chip, px(4));
    list_.AddText({min.x + pad_x, min.y + pad_y}, colour, shown.c_str());
  }
  ImGui::PopFont();
  return free || always;
}

void RoomDrawing::words(const glm::dvec2& pixel, std::string_view text, std::uint32_t colour) {
  ImGui::PushFont(small_font());
  const ImVec2 size = ImGui::CalcTextSize(text.data(), text.data() + text.size());
  const ImVec2 at = frame_.on_window(pixel);
  list_.AddText({std::floor(at.x - 0.5f * size.x), std::floor(at.y - 0.5f * size.y)}, colour, text.data(),
                text.data() + text.size());
  ImGui::PopFont();
}

}  // namespace focalstage
