// The File menu of the bar.
#include "editor/session/session.h"
#include "editor/window/base/button.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/bar_part.h"
#include "editor/window/panels/menu.h"

namespace focalstage {
namespace {

void sample_rows(Session& session) {
  for (const SampleCard& card : session.sample_cards()) {
    ListRowStyle style;
    style.icon = "sample";
    style.tip.help = card.says;
    if (!menu_row(card.name, card.title, style)) continue;
    Value args;
    args.set("from", card.name);
    (void)session.run("file.new", args);
  }
}

void recent_rows(Session& session) {
  if (session.recent().empty()) {
    ListRowStyle style;
    style.tip.unavailable = "nothing was opened yet";
    menu_row("none", "Nothing yet", style);
    return;
  }
  const auto recent = session.recent();  // opening one changes the list
  for (const auto& path : recent) {
    ListRowStyle style;
    style.icon = "folder";
    const std::string whole = path.string();
    style.tip.help = whole;
    if (!menu_row(whole, path.stem().string(), style)) continue;
    Value args;
    args.set("path", whole);
    (void)session.run("file.open", args);
  }
}

void file_rows(Session& session) {
  command_row(session, "file.new");
  if (begin_submenu("New from sample", "sample", px(230))) {
    const NameScope scope("New from sample");
    sample_rows(session);
    end_submenu();
  }
  command_row(session, "file.open");
  if (begin_submenu("Recent", "history", px(280))) {
    const NameScope scope("Recent");
    recent_rows(session);
    end_submenu();
  }
  menu_line();
  command_row(session, "file.save");
  command_row(session, "file.save-as");
  command_row(session, "file.import");
  menu_line();
  command_row(session, "app.palette");
  menu_line();
  command_row(session, "file.close");
  command_row(session, "app.quit");
}

class FilePart final : public BarPart {
 public:
  BarItem look(const Session&) override {
    return {{button_size("File", style(0)).x, button_size("", style(1)).x}, {90}};
  }

  void draw(Session& session, std::size_t form) override {
    const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
    const bool pressed = named_button("File", form == 0 ? "File" : "", style(form));
    const glm::vec2 max = from_im(ImGui::GetItemRectMax());
    if (!begin_menu("file menu", pressed, min, max, px(280))) return;
    const NameScope scope("File");
    file_rows(session);
    end_menu();
  }

 private:
  static ButtonStyle style(std::size_t form) {
    ButtonStyle style;
    style.look = ButtonLook::quiet;
    if (form > 0) style.icon = "menu";
    return style;
  }
};

}  // namespace

BarPartPtr make_file_part() { return std::make_unique<FilePart>(); }

}  // namespace focalstage
