#include "editor/window/panels/file_panel.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/dialog.h"
#include "editor/window/panels/file_browser.h"
#include "editor/window/panels/key_pressed.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

/// What the dialog says for each wish.
struct Words {
  const char* title;
  const char* hint;
  const char* accept;
  const char* command;
  Listed listed;
};

Words words_of(FileWish wish) {
  switch (wish) {
    case FileWish::save_as:
      return {"Save the project into a folder of its own", "Name of the folder", "Save", "file.save-as",
              Listed::folders};
    case FileWish::import_mesh:
      return {"Import a mesh or a picture", "Name or path of a file", "Import", "file.import", Listed::assets};
    case FileWish::open:
    case FileWish::none:
      break;
  }
  return {"Open a project", "Name or path of a project", "Open", "file.open", Listed::projects};
}

bool is_folder(const fs::path& path) {
  std::error_code none;
  return fs::is_directory(path, none);
}

bool is_project_folder(const fs::path& path) {
  const auto listed = list_folder(path, Listed::projects);
  return listed && std::ranges::any_of(*listed, [](const FolderEntry& entry) { return !entry.folder; });
}

class FilePanel final : public Panel {
 public:
  std::string_view name() const override { return "files"; }
  PanelPlace place() const override { return PanelPlace::over; }

  void draw(Session& session, const PaneRect& rect) override {
    const FileWish wish = session.file_wish();
    if (wish != wish_) begin(session, wish);
    if (wish == FileWish::none || session.question()) return;
    if (!begin_dialog("file dialog", rect, px(760), px(520))) return;
    draw_inside(session, words_of(wish));
    const bool over = session.file_wish() == FileWish::none;
    if (over) close_dialog();
    end_dialog();
    if (over) wish_ = FileWish::none;
  }

 private:
  void begin(const Session& session, FileWish wish) {
    wish_ = wish;
    if (wish == FileWish::none) return;
    problem_.clear();
    text_ = wish == FileWish::save_as ? session.project().name : "";
    std::ranges::replace(text_, '/', '-');
    focus_ = true;
    browser_.look_for(words_of(wish).listed);
    browser_.go(first_folder(session, wish));
  }

  fs::path first_folder(const Session& session, FileWish wish) const {
    if (wish == FileWish::import_mesh && !imported_from_.empty() && is_folder(imported_from_)) return imported_from_;
    if (wish == FileWish::save_as && !session.document().untitled()) return session.document().folder().parent_path();
    if (wish != FileWish::import_mesh && !session.recent().empty()) {
      return session.recent().front().parent_path().parent_path();
    }
    return home_folder();
  }

  std::vector<fs::path> places(const Session& session) const {
    std::vector<fs::path> list{home_folder()};
    const auto add = [&](const fs::path& folder) {
      if (list.size() < 8 && std::ranges::find(list, folder) == list.end()) list.push_back(folder);
    };
    if (session.has_document() && !session.document().untitled()) add(session.document().folder().parent_path());
    for (const fs::path& project : session.recent()) add(project.parent_path().parent_path());
    if (!imported_from_.empty()) add(imported_from_);
    list.push_back("/");
    return list;
  }

  void draw_inside(Session& session, const Words& words) {
    ImGui::PushFont(strong_font());
    paragraph(words.title);
    ImGui::PopFont();
    ImGui::Dummy({0.0f, px(2)});
    draw_place_line();
    const float below = 2.0f * ImGui::GetFrameHeight() + ImGui::GetTextLineHeight() + px(34);
    const float height = std::max(ImGui::GetContentRegionAvail().y - below, px(60));
    draw_lists(session, words, height);
    draw_field(session, words);
    draw_message(words);
    draw_buttons(session, words);
    if (key_pressed(ImGuiKey_Escape) && !ImGui::IsWindowAppearing()) session.forget_file_wish();
  }

  void draw_place_line() {
    ButtonStyle up;
    up.icon = "up";
    up.tip.help = "The folder above";
    if (browser_.folder() == "/") up.tip.unavailable = "this is the top";
    if (icon_button("up", up)) go(browser_.folder().parent_path());
    ImGui::SameLine(0.0f, px(10));
    ImGui::AlignTextToFramePadding();
    const std::string shown = path_end(browser_.folder(), ImGui::GetContentRegionAvail().x);
    want_glyphs(shown);
    text_line(shown, theme::dim);
  }

  void draw_lists(Session& session, const Words& words, float height) {
    const float room = ImGui::GetContentRegionAvail().x;
    const float side = room >= px(520) ? px(170) : 0.0f;
    if (side > 0.0f) {
      if (ImGui::BeginChild("places", {side, height})) {
        if (const auto place = FileBrowser::draw_places(places(session), browser_.folder())) go(*place);
      }
      ImGui::EndChild();
      ImGui::SameLine(0.0f, px(10));
    }
    const bool moved = browser_.follow_keys();
    const FileBrowser::Press press = browser_.draw(height);
    const FolderEntry* chosen = browser_.chosen();
    if (!chosen) return;
    if ((moved || press.chose) && words.listed != Listed::folders) text_ = chosen->name;
    if (moved || press.chose) problem_.clear();
    if (press.entered) enter(session, words, *chosen);
  }

  void draw_field(Session& session, const Words& words) {
    ImGui::Dummy({0.0f, px(2)});
    FieldStyle field;
    field.hint = words.hint;
    field.width_px = ImGui::GetContentRegionAvail().x;
    field.focus = focus_;
    focus_ = false;
    const bool was_empty = text_.empty();
    const TextChange change = text_field("path", text_, field);
    if (change.changed) problem_.clear();
    if (was_empty && key_pressed(ImGuiKey_Backspace, true)) go(browser_.folder().parent_path());
    if (change.entered) accept(session, words);
  }

  void draw_message(const Words& words) {
    std::string message = problem_;
    std::uint32_t colour = theme::red;
    if (message.empty() && words.listed == Listed::folders) {
      const fs::path target = typed_path(text_, browser_.folder());
      message = text_.empty() ? "The folder that is made will hold the project and all its files."
                              : "Makes " + path_end(target, ImGui::GetContentRegionAvail().x - px(80));
      colour = theme::dim;
    }
    if (message.empty())
      message = words.listed == Listed::assets
                    ? "glTF, OBJ, PLY, STL and OFF meshes; PNG and JPEG pictures, which become planes."
                    : " ";
    elided_line(message, 0.0f, problem_.empty() ? theme::dim : colour);
  }

  void draw_buttons(Session& session, const Words& words) {
    ImGui::Dummy({0.0f, px(2)});
    ButtonStyle style;
    style.width_px = px(96);
    ButtonStyle accept_style = style;
    accept_style.look = ButtonLook::accent;
    if (text_.empty() && !browser_.chosen()) accept_style.tip.unavailable = "choose something first";
    const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
    ImGui::SetCursorPosX(right - 2.0f * style.width_px - px(8));
    if (button("Cancel", style)) session.forget_file_wish();
    ImGui::SameLine(0.0f, px(8));
    if (named_button("accept", words.accept, accept_style)) accept(session, words);
  }

  void go(const fs::path& folder) {
    problem_.clear();
    browser_.go(folder);
    focus_ = true;
    if (wish_ != FileWish::save_as) text_.clear();
  }

  /// A double click: into a folder, or takes what was clicked.
  void enter(Session& session, const Words& words, const FolderEntry& entry) {
    const fs::path path = entry.path;
    if (entry.folder && !(entry.project && words.listed == Listed::projects)) {
      go(path);
    } else {
      take(session, words, path);
    }
  }

  /// Enter, or the button: what stands in the field.
  void accept(Session& session, const Words& words) {
    if (text_.empty()) {
      if (browser_.chosen()) enter(session, words, *browser_.chosen());
      return;
    }
    const fs::path path = typed_path(text_, browser_.folder());
    if (words.listed == Listed::folders) return take(session, words, path);
    if (is_folder(path) && !(words.listed == Listed::projects && is_project_folder(path))) return go(path);
    std::error_code none;
    if (!fs::exists(path, none)) {
      problem_ = "There is no \"" + path.filename().string() + "\" in " + path.parent_path().string();
      focus_ = true;
      return;
    }
    take(session, words, path);
  }

  void take(Session& session, const Words& words, const fs::path& path) {
    if (words.listed == Listed::assets) imported_from_ = path.parent_path();
    Value args;
    args.set("path", path.string());
    const Status done = session.run(words.command, args);
    if (done) {
      // Saving may have led to what waited for it, which may ask for another path.
      if (words.listed != Listed::folders) session.forget_file_wish();
      return;
    }
    session.dismiss_notice();  // said here
    problem_ = describe(done.fault());
    focus_ = true;
    (void)session.run(words.command);
  }

  FileWish wish_ = FileWish::none;
  FileBrowser browser_;
  std::string text_;
  std::string problem_;
  fs::path imported_from_;
  bool focus_ = false;
};

}  // namespace

std::unique_ptr<Panel> make_file_panel() { return std::make_unique<FilePanel>(); }

}  // namespace focalstage
