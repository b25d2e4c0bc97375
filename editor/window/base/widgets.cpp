#include "editor/window/base/widgets.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "editor/window/base/fonts.h"
#include "editor/window/base/frame_wish.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"

namespace focalstage {
namespace {

float text_width(std::string_view text) { return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x; }

/// The start of the UTF-8 character that holds byte `at`.
std::size_t character_start(std::string_view text, std::size_t at) {
  while (at > 0 && at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0u) == 0x80u) --at;
  return at;
}

float right_column() { return std::clamp(std::round(ImGui::GetContentRegionAvail().x * 0.45f), px(70), px(180)); }

void dim_label(std::string_view label, const Tip& tip, float width_px) {
  const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
  ImGui::Dummy({width_px, ImGui::GetFrameHeight()});
  tip_for_last_item(tip);
  const std::string shown = elided(label, width_px - px(6));
  ImGui::GetWindowDrawList()->AddText({min.x, min.y + ImGui::GetStyle().FramePadding.y}, theme::dim, shown.c_str());
}

}  // namespace

void text_line(std::string_view text, std::uint32_t colour) {
  want_glyphs(text);
  if (text.empty()) text = "";  // ImGui reads from the pointer, which an empty view may lack
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopStyleColor();
}

std::string elided(std::string_view text, float width_px) {
  // Long names: no more characters are measured than could fit.
  const auto most = static_cast<std::size_t>(std::max(width_px, 0.0f)) * 2 + 8;
  if (text.size() <= most && text_width(text) <= width_px) return std::string(text);
  const float room = width_px - text_width("…");
  std::size_t low = 0;
  std::size_t high = std::min(text.size(), most);
  while (low < high) {
    const std::size_t middle = (low + high + 1) / 2;
    if (text_width(text.substr(0, character_start(text, middle))) <= room) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return std::string(text.substr(0, character_start(text, low))) + "…";
}

void elided_line(std::string_view text, float width_px, std::uint32_t colour) {
  const float room = width_px > 0.0f ? width_px : ImGui::GetContentRegionAvail().x;
  const std::string shown = elided(text, room);
  text_line(shown, colour);
  want_glyphs(text);
  if (shown != text) tip_for_last_item({text, {}, {}});
}

void paragraph(std::string_view text, std::uint32_t colour) {
  ImGui::PushTextWrapPos(0.0f);
  text_line(text, colour);
  ImGui::PopTextWrapPos();
}

void title_line(std::string_view text) {
  ImGui::PushFont(title_font());
  elided_line(text);
  ImGui::PopFont();
}

bool section(std::string_view title, bool open_at_first) {
  ImGuiStorage& storage = *ImGui::GetStateStorage();
  const ImGuiID id = ImGui::GetID(title.data(), title.data() + title.size());
  bool open = storage.GetBool(id, open_at_first);
  ImGui::Dummy({0.0f, px(4)});
  const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
  const glm::vec2 size(ImGui::GetContentRegionAvail().x, ImGui::GetFrameHeight());
  ImGui::PushID(title.data(), title.data() + title.size());
  if (ImGui::InvisibleButton("section", {std::max(size.x, px(20)), size.y})) {
    open = !open;
    storage.SetBool(id, open);
  }
  ImGui::PopID();
  see_last_item(title);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float y = min.y + ImGui::GetStyle().FramePadding.y;
  draw_text(list, *strong_font(), {min.x, y}, theme::text, title);
  const std::string_view caret = icon(open ? "unfolded" : "folded");
  if (!open || ImGui::IsItemHovered()) {
    draw_text(list, *small_font(), {min.x + size.x - px(18), y + px(1)}, theme::dim, caret);
  }
  return open;
}

void property_row(std::string_view label, const Tip& tip) {
  const float right = right_column();
  const float left = ImGui::GetContentRegionAvail().x - right;
  dim_label(label, tip, left);
  ImGui::SameLine(0.0f, 0.0f);
  ImGui::SetNextItemWidth(right);
}

void property_value(std::string_view label, std::string_view value, std::uint32_t colour) {
  want_glyphs(value);
  const float room = ImGui::GetContentRegionAvail().x;
  const float wanted = std::min(text_width(value), room * 0.65f);
  const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
  dim_label(label, {}, room);
  const std::string shown = elided(value, wanted + 1.0f);
  const glm::vec2 at(min.x + room - wanted - ImGui::GetStyle().FramePadding.x,
                     min.y + ImGui::GetStyle().FramePadding.y);
  ImGui::GetWindowDrawList()->AddText(to_im(glm::floor(at)), colour, shown.c_str());
}

void progress_bar(double share, float width_px) {
  const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
  const float width = width_px > 0.0f ? width_px : ImGui::GetContentRegionAvail().x;
  const float height = px(4);
  ImGui::Dummy({width, height});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(to_im(min), {min.x + width, min.y + height}, theme::field, height * 0.5f);
  float begin = 0.0f;
  float end = static_cast<float>(std::clamp(share, 0.0, 1.0));
  if (share < 0.0) {  // nobody knows: a piece that wanders
    begin = static_cast<float>(std::fmod(ImGui::GetTime() * 0.6, 1.3)) - 0.3f;
    end = std::min(begin + 0.3f, 1.0f);
    begin = std::max(begin, 0.0f);
    want_frame_within(1.0 / 30.0);
  }
  if (end <= begin) return;
  list.AddRectFilled({min.x + begin * width, min.y}, {min.x + end * width, min.y + height}, theme::accent,
                     height * 0.5f);
}

}  // namespace focalstage
