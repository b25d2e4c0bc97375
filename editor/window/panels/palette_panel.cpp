#include "editor/window/panels/palette_panel.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "editor/session/palette.h"
#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/key_pressed.h"

namespace focalstage {
namespace {

constexpr const char* popup = "palette";

struct RowPlace {
  glm::vec2 min;
  glm::vec2 max;
};

/// The title with the letters that were found in it lit.
float draw_title(ImDrawList& list, glm::vec2 at, const PaletteEntry& entry, float room) {
  const std::string shown = elided(entry.title, room);
  const bool can = entry.unavailable.empty();
  list.AddText(to_im(at), can ? theme::text : theme::faint, shown.c_str());
  for (const std::size_t byte : entry.matched) {
    if (byte >= shown.size() || entry.title[byte] != shown[byte]) break;
    const float x = at.x + ImGui::CalcTextSize(shown.c_str(), shown.c_str() + byte).x;
    const char* begin = shown.c_str() + byte;
    const char* end = begin + 1;
    while ((static_cast<unsigned char>(*end) & 0xC0u) == 0x80u) ++end;
    list.AddText({x, at.y}, can ? theme::accent : theme::dim, begin, end);
  }
  return ImGui::CalcTextSize(shown.c_str()).x;
}

void draw_entry(const PaletteEntry& entry, const RowPlace& place, bool selected) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (selected) list.AddRectFilled(to_im(place.min), to_im(place.max), theme::selection, px(4));
  const bool can = entry.unavailable.empty();
  const float y = place.min.y + px(4);
  const std::string_view glyph = icon(entry.icon);
  if (!glyph.empty()) {
    list.AddText({place.min.x + px(8), y}, can ? theme::dim : theme::faint, glyph.data(), glyph.data() + glyph.size());
  }
  float right = place.max.x - px(10);
  if (!entry.shortcut.empty()) {
    right -= ImGui::CalcTextSize(entry.shortcut.c_str()).x;
    list.AddText({right, y}, can ? theme::dim : theme::faint, entry.shortcut.c_str());
    right -= px(14);
  }
  const float left = place.min.x + px(34);
  const float title = draw_title(list, {left, y}, entry, right - left);
  const std::string& beside = can ? entry.help : entry.unavailable;
  const float room = right - left - title - px(14);
  if (beside.empty() || room < px(60)) return;
  ImGui::PushFont(small_font());
  const std::string shown = elided(beside, room);
  ImGui::PopFont();
  list.AddText(small_font(), small_font()->FontSize, {left + title + px(14), y + px(1)}, theme::dim, shown.c_str());
}

class PalettePanel final : public Panel {
 public:
  std::string_view name() const override { return "palette"; }
  PanelPlace place() const override { return PanelPlace::over; }

  void draw(Session& session, const PaneRect& rect) override {
    if (!session.palette_open()) {
      was_open_ = false;
      return;
    }
    const bool opening = !was_open_;
    if (opening) open();
    if (!ImGui::IsPopupOpen(popup)) {  // a click beside it
      session.close_palette();
      was_open_ = false;
      return;
    }
    const float width = std::min(px(620), rect.size.x - px(24));
    const float top = std::floor(std::min(rect.size.y * 0.12f, px(120)));
    ImGui::SetNextWindowPos({std::floor(0.5f * (rect.size.x - width)), top});
    const float rows = static_cast<float>(std::max<std::size_t>(rows_, 1)) * (ImGui::GetFontSize() + px(8));
    const float wanted = rows + ImGui::GetFrameHeight() + px(24);
    ImGui::SetNextWindowSize({width, std::min({wanted, px(430), rect.size.y - top - px(12)})});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(8), px(8)});
    if (ImGui::BeginPopup(popup, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoScrollbar)) {
      draw_inside(session, opening);
      ImGui::EndPopup();
    }
    ImGui::PopStyleVar();
  }

 private:
  void open() {
    was_open_ = true;
    query_.clear();
    chosen_ = 0;
    ImGui::OpenPopup(popup);
  }

  void draw_inside(Session& session, bool opening) {
    FieldStyle field;
    field.hint = "Find a command, or a thing by its name";
    field.width_px = ImGui::GetContentRegionAvail().x;
    field.focus = opening;
    const TextChange change = text_field("query", query_, field);
    if (change.changed) chosen_ = 0;
    const std::vector<PaletteEntry> entries = palette_entries(session, query_);
    rows_ = entries.size();
    const bool moved = follow_keys(entries.size());
    if (key_pressed(ImGuiKey_Escape)) return close(session);
    if (entries.empty()) {
      ImGui::Dummy({0.0f, px(4)});
      paragraph("Nothing is called like that.", theme::dim);
    }
    const auto pressed = draw_entries(entries, moved || change.changed || opening);
    if (pressed >= 0) run(session, entries[static_cast<std::size_t>(pressed)]);
    if (change.entered && chosen_ < entries.size()) run(session, entries[chosen_]);
  }

  bool follow_keys(std::size_t count) {
    if (count == 0) return false;
    chosen_ = std::min(chosen_, count - 1);
    const std::size_t before = chosen_;
    if (key_pressed(ImGuiKey_DownArrow, true)) chosen_ = chosen_ + 1 < count ? chosen_ + 1 : 0;
    if (key_pressed(ImGuiKey_UpArrow, true)) chosen_ = chosen_ > 0 ? chosen_ - 1 : count - 1;
    if (key_pressed(ImGuiKey_PageDown, true)) chosen_ = std::min(chosen_ + 10, count - 1);
    if (key_pressed(ImGuiKey_PageUp, true)) chosen_ -= std::min<std::size_t>(chosen_, 10);
    return chosen_ != before;
  }

  /// The one that was pressed; -1: none.
  int draw_entries(const std::vector<PaletteEntry>& entries, bool reveal) {
    int pressed = -1;
    if (ImGui::BeginChild("entries")) {
      ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(8), 0.0f});
      const float height = ImGui::GetFontSize() + px(8);
      for (std::size_t i = 0; i < entries.size(); ++i) {
        const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
        const float width = ImGui::GetContentRegionAvail().x;
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::InvisibleButton("entry", {std::max(width, px(20)), height})) pressed = static_cast<int>(i);
        ImGui::PopID();
        if (reveal && i == chosen_) ImGui::SetScrollHereY(0.5f);
        if (!ImGui::IsItemVisible()) continue;
        see_last_item(entries[i].title, entries[i].unavailable.empty());
        const ImVec2 moved = ImGui::GetIO().MouseDelta;
        if (ImGui::IsItemHovered() && (moved.x != 0.0f || moved.y != 0.0f)) chosen_ = i;
        draw_entry(entries[i], {min, min + glm::vec2(width, height)}, i == chosen_);
      }
      ImGui::PopStyleVar();
    }
    ImGui::EndChild();
    return pressed;
  }

  void run(Session& session, const PaletteEntry& entry) {
    if (!entry.unavailable.empty()) return;
    close(session);
    (void)session.run(entry.command, entry.args);
  }

  void close(Session& session) {
    session.close_palette();
    was_open_ = false;
    ImGui::CloseCurrentPopup();
  }

  bool was_open_ = false;
  std::string query_;
  std::size_t chosen_ = 0;
  std::size_t rows_ = 20;  ///< that there were to show last
};

}  // namespace

std::unique_ptr<Panel> make_palette_panel() { return std::make_unique<PalettePanel>(); }

}  // namespace focalstage
