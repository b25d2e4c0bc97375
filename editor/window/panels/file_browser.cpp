#include "editor/window/panels/file_browser.h"

#include <algorithm>

#include "editor/window/base/fonts.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/key_pressed.h"

namespace focalstage {

namespace fs = std::filesystem;

void FileBrowser::look_for(Listed wanted) {
  wanted_ = wanted;
  refresh();
}

void FileBrowser::go(const fs::path& folder) {
  folder_ = folder.lexically_normal();
  if (!folder_.has_filename() && folder_.has_relative_path()) folder_ = folder_.parent_path();
  refresh();
}

void FileBrowser::refresh() {
  entries_.clear();
  problem_.clear();
  chosen_ = -1;
  if (folder_.empty()) return;
  auto listed = list_folder(folder_, wanted_);
  if (!listed) {
    problem_ = "This folder cannot be read: " + listed.fault().message;
    return;
  }
  entries_ = std::move(*listed);
  for (const FolderEntry& entry : entries_) want_glyphs(entry.name);
}

const FolderEntry* FileBrowser::chosen() const {
  return chosen_ >= 0 && chosen_ < static_cast<int>(entries_.size()) ? &entries_[static_cast<std::size_t>(chosen_)]
                                                                     : nullptr;
}

bool FileBrowser::follow_keys() {
  const int count = static_cast<int>(entries_.size());
  if (count == 0) return false;
  int next = chosen_;
  if (key_pressed(ImGuiKey_DownArrow, true)) ++next;
  if (key_pressed(ImGuiKey_UpArrow, true)) --next;
  if (key_pressed(ImGuiKey_PageDown, true)) next += 10;
  if (key_pressed(ImGuiKey_PageUp, true)) next -= 10;
  if (next == chosen_) return false;
  chosen_ = std::clamp(next, 0, count - 1);
  reveal_ = true;
  return true;
}

FileBrowser::Press FileBrowser::draw_entry(std::size_t index) {
  const FolderEntry& entry = entries_[index];
  std::string right;
  if (!entry.folder) right = size_words(entry.bytes) + "    ";
  right += time_words(entry.when, fs::file_time_type::clock::now());
  ListRowStyle style;
  style.icon = entry.project ? "room" : entry.folder ? "folder" : wanted_ == Listed::projects ? "room" : "mesh";
  style.icon_colour = entry.project || !entry.folder ? theme::accent : theme::dim;
  style.right = right;
  style.selected = static_cast<int>(index) == chosen_;
  const RowPress press = list_row(entry.name, entry.name, style);
  if (press.clicked) chosen_ = static_cast<int>(index);
  return {press.clicked, press.double_clicked};
}

FileBrowser::Press FileBrowser::draw(float height_px) {
  Press press;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::panel);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(8), px(1)});
  if (ImGui::BeginChild("entries", {0.0f, height_px})) {
    const NameScope scope("entries");
    if (entries_.empty()) {
      ImGui::Dummy({0.0f, px(4)});
      ImGui::Indent(px(8));
      const char* nothing = wanted_ == Listed::folders ? "No folders here." : "Nothing here to choose.";
      paragraph(problem_.empty() ? nothing : problem_, problem_.empty() ? theme::dim : theme::red);
      ImGui::Unindent(px(8));
    }
    const float row = ImGui::GetFontSize() + px(7);
    if (reveal_) ImGui::SetScrollY(std::max(0.0f, static_cast<float>(chosen_) * row - 0.5f * height_px));
    reveal_ = false;
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(entries_.size()), row);
    while (clipper.Step()) {
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
        const Press here = draw_entry(static_cast<std::size_t>(i));
        press.chose |= here.chose;
        press.entered |= here.entered;
      }
    }
    clipper.End();
  }
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  return press;
}

std::optional<fs::path> FileBrowser::draw_places(const std::vector<fs::path>& places, const fs::path& now) {
  const NameScope scope("places");
  std::optional<fs::path> pressed;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(8), px(1)});
  for (const fs::path& place : places) {
    const std::string whole = place.string();
    const bool home = place == home_folder();
    const std::string label = home ? "Home" : whole == "/" ? "Computer" : place.filename().string();
    ListRowStyle style;
    style.icon = home ? "home" : whole == "/" ? "disk" : "folder";
    style.selected = place == now;
    style.tip.help = whole;
    if (list_row(whole, label, style).clicked) pressed = place;
  }
  ImGui::PopStyleVar();
  return pressed;
}

std::string path_end(const fs::path& path, float width_px) {
  std::string whole = path.string();
  std::string shown = whole;
  while (ImGui::CalcTextSize(shown.c_str()).x > width_px) {
    const std::size_t cut = whole.find('/', 1);
    if (cut == std::string::npos) return elided(shown, width_px);
    whole = whole.substr(cut);
    shown = "…" + whole;
  }
  return shown;
}

}  // namespace focalstage
