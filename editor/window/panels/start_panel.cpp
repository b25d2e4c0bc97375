#include "editor/window/panels/start_panel.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "editor/session/folder_listing.h"
#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/command_widgets.h"
#include "editor/window/panels/sample_grid.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

void heading(std::string_view text) {
  ImGui::PushFont(strong_font());
  text_line(text);
  ImGui::PopFont();
  ImGui::Dummy({0.0f, px(1)});
}

/// "Move rabbit, Add box, Set light of wall and 9 more"
std::string some_of(const std::vector<std::string>& words) {
  constexpr std::size_t most = 4;
  std::string list;
  for (std::size_t i = 0; i < std::min(words.size(), most); ++i) list += (i == 0 ? "" : ", ") + words[i];
  if (words.size() > most) list += " and " + std::to_string(words.size() - most) + " more";
  return list;
}

std::string name_of(const Recovery& recovery) {
  return recovery.untitled ? "A project that was never saved" : fs::path(recovery.project_file).stem().string();
}

class StartPanel final : public Panel {
 public:
  std::string_view name() const override { return "start"; }
  PanelPlace place() const override { return PanelPlace::start; }

  void draw(Session& session, const PaneRect& rect) override {
    const float margin = std::max(px(16), std::floor(0.5f * (rect.size.x - px(widest))));
    const bool wide = rect.size.x >= px(two_columns);
    ImGui::SetCursorPos({margin, std::max(px(20), std::min(std::floor(rect.size.y * 0.07f), px(64)))});
    const ImGuiTableFlags flags = ImGuiTableFlags_NoSavedSettings | ImGuiTableFlags_NoPadOuterX;
    if (!ImGui::BeginTable("start", wide ? 2 : 1, flags, {rect.size.x - 2.0f * margin - px(12), 0.0f})) return;
    if (wide) ImGui::TableSetupColumn("left", ImGuiTableColumnFlags_WidthFixed, px(left_column));
    ImGui::TableNextColumn();
    draw_title(session);
    if (!session.has_document()) draw_recoveries(session);
    if (!session.has_document()) draw_recent(session);
    ImGui::TableNextColumn();
    if (!session.has_document()) draw_samples(session, wide);
    ImGui::EndTable();
    ImGui::Dummy({0.0f, px(16)});
  }

 private:
  static constexpr double widest = 1180.0;
  static constexpr double two_columns = 820.0;
  static constexpr double left_column = 340.0;

  static void draw_title(Session& session) {
    ImGui::PushFont(title_font());
    text_line("Focalstage");
    ImGui::PopFont();
    paragraph("Pictures in focus where you want them, on real things.", theme::dim);
    ImGui::Dummy({0.0f, px(6)});
    ButtonStyle style;
    style.look = ButtonLook::accent;
    style.icon = "file";
    style.tip.help = "A bare room with a viewer, a screen and a projector";
    command_button(session, "file.new", "New", "New project", style);
    ImGui::SameLine(0.0f, px(8));
    ButtonStyle open;
    open.icon = "folder";
    command_button(session, "file.open", "Open", "Open…", open);
    ImGui::Dummy({0.0f, px(2)});
    paragraph("Or drop a project's folder here.", theme::dim);
    ImGui::Dummy({0.0f, px(10)});
  }

  void draw_recoveries(Session& session) {
    const auto& left = session.left_behind();
    if (left.empty()) return;
    heading("Not saved when the editor ended");
    const NameScope scope("recoveries");
    for (std::size_t i = 0; i < left.size() && i < 5; ++i) {
      if (draw_recovery(session, i, left[i])) return;  // the list is another one now
      ImGui::Dummy({0.0f, px(4)});
    }
    ImGui::Dummy({0.0f, px(8)});
  }

  /// True when it was recovered or forgotten.
  bool draw_recovery(Session& session, std::size_t index, const Recovery& recovery) {
    const std::string number = std::to_string(index);
    const std::size_t steps = recovery.words.size();
    ImGui::PushID(number.c_str());
    elided_line(name_of(recovery));
    const std::string count = std::to_string(steps) + (steps == 1 ? " step" : " steps");
    const auto now = fs::file_time_type::clock::now();
    text_line(count + ", " + time_words(recovery.when, now), theme::dim);
    const std::string words = some_of(recovery.words);
    ImGui::PushFont(small_font());
    if (!words.empty()) elided_line(words, 0.0f, theme::dim);
    ImGui::PopFont();
    Value args;
    args.set("index", static_cast<double>(index));
    ButtonStyle recover;
    recover.icon = "undo";
    recover.tip.help = "Open it as it was; Undo reaches behind the crash";
    bool changed = command_button(session, "file.recover", "Recover " + number, "Recover", recover, args);
    ImGui::SameLine(0.0f, px(8));
    changed = changed || draw_forget(session, index, args);
    ImGui::PopID();
    return changed;
  }

  /// What is forgotten is gone for good: asked twice, at the same place.
  bool draw_forget(Session& session, std::size_t index, const Value& args) {
    const std::string number = std::to_string(index);
    ButtonStyle style;
    style.look = ButtonLook::quiet;
    if (sure_ != index) {
      style.tip.help = "Give up these steps";
      if (named_button("Forget " + number, "Forget", style)) sure_ = index;
      return false;
    }
    if (!command_button(session, "file.forget", "Forget " + number, "Forget for good?", style, args)) return false;
    sure_.reset();
    return true;
  }

  void draw_recent(Session& session) {
    heading("Recent");
    const NameScope scope("recent");
    const auto recent = session.recent();  // opening one changes the list
    if (recent.empty()) {
      paragraph("Projects you open or save will be listed here.", theme::dim);
      return;
    }
    const auto now = fs::file_time_type::clock::now();
    for (const fs::path& path : recent) {
      std::error_code none;
      if (!draw_recent_row(path, time_words(fs::last_write_time(path, none), now))) continue;
      Value args;
      args.set("path", path.string());
      (void)session.run("file.open", args);
      return;
    }
  }

  static bool draw_recent_row(const fs::path& path, const std::string& when) {
    const std::string whole = path.string();
    const std::string folder = path.parent_path().parent_path().string();
    ListRowStyle style;
    style.icon = "folder";
    style.right = when;
    style.tip.help = whole;
    const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
    const std::string label = path.stem().string();
    const bool pressed = list_row(whole, label, style).clicked;
    // The folder in the room that the name and the time leave.
    const glm::vec2 max = from_im(ImGui::GetItemRectMax());
    const float left = min.x + px(40) + ImGui::CalcTextSize(label.c_str()).x;
    const float right = max.x - px(24) - ImGui::CalcTextSize(when.c_str()).x;
    if (right - left > px(40)) {
      ImGui::PushFont(small_font());
      const std::string shown = elided(folder, right - left);
      ImGui::GetWindowDrawList()->AddText({left, min.y + px(4)}, theme::dim, shown.c_str());
      ImGui::PopFont();
    }
    return pressed;
  }

  void draw_samples(Session& session, bool wide) {
    if (!wide) ImGui::Dummy({0.0f, px(10)});
    heading("Samples");
    grid_.draw(session);
  }

  std::optional<std::size_t> sure_;
  SampleGrid grid_;
};

}  // namespace

std::unique_ptr<Panel> make_start_panel() { return std::make_unique<StartPanel>(); }

}  // namespace focalstage
