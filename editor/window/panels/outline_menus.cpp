#include "editor/window/panels/outline_menus.h"

#include <array>
#include <string>

#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/menu.h"

namespace focalstage {
namespace {

struct Addable {
  const char* kind;
  const char* label;
};

constexpr std::array<Addable, 5> surfaces{
    {{"plane", "Plane"}, {"corner", "Corner"}, {"step", "Step"}, {"box", "Box"}, {"sphere", "Sphere"}}};
constexpr std::array<Addable, 7> objects{{{"rabbit", "Rabbit"},
                                          {"teapot", "Teapot"},
                                          {"sphere", "Sphere"},
                                          {"box", "Box"},
                                          {"plane", "Plane"},
                                          {"corner", "Corner"},
                                          {"step", "Step"}}};
constexpr std::array<Addable, 3> lights{{{"sun", "Sun"}, {"point", "Point"}, {"sky", "Sky"}}};

void heading(const char* text) {
  ImGui::PushFont(small_font());
  ImGui::Indent(px(6));
  ImGui::Dummy({0.0f, px(2)});
  text_line(text, theme::dim);
  ImGui::Unindent(px(6));
  ImGui::PopFont();
}

template <std::size_t N>
void add_rows(Session& session, const char* title, const char* command, const char* icon_name,
              const std::array<Addable, N>& kinds) {
  heading(title);
  for (const Addable& one : kinds) {
    ListRowStyle style;
    style.icon = icon_name;
    if (!menu_row(std::string(title) + " " + one.kind, one.label, style)) continue;
    Value args;
    args.set("kind", one.kind);
    (void)session.run(command, args);
  }
}

/// The selected thing whose mesh another file can replace; null for none or several.
const Thing* replaceable(const Session& session) {
  const auto& things = session.selection().things;
  const bool one = things.size() == 1 && (things[0].list == "objects" || things[0].list == "surfaces");
  return one ? &things[0] : nullptr;
}

}  // namespace

void add_button(Session& session) {
  ButtonStyle style;
  style.icon = "add";
  style.look = ButtonLook::plain;
  style.tip.help = "Add a surface, an object, a light or a slice";
  const bool pressed = button("Add", style);
  const glm::vec2 min = from_im(ImGui::GetItemRectMin());
  const glm::vec2 max = from_im(ImGui::GetItemRectMax());
  if (!begin_menu("add", pressed, min, max, px(200))) return;
  {
    const NameScope scope("add");
    add_rows(session, "Surface", "add.surface", "surface", surfaces);
    add_rows(session, "Object", "add.object", "object", objects);
    command_row(session, "file.import", "From a file…");
    add_rows(session, "Light", "add.light", "light", lights);
    heading("Show");
    command_row(session, "add.slice", "Slice");
    command_row(session, "cue.add", "Cue at this frame");
  }
  end_menu();
}

void outline_menu(Session& session, bool open) {
  static glm::vec2 at{0.0f};
  const ImGuiIO& io = ImGui::GetIO();
  if (open) {
    const float height = 15.0f * (ImGui::GetFontSize() + px(8)) + px(30);
    at = {io.MousePos.x, std::max(px(4), std::min(io.MousePos.y, io.DisplaySize.y - height))};
  }
  if (!begin_menu("outline menu", open, at, at, px(230))) return;
  {
    const NameScope scope("menu");
    command_row(session, "edit.rename");
    command_row(session, "edit.duplicate");
    command_row(session, "edit.cut");
    command_row(session, "edit.copy");
    command_row(session, "edit.paste");
    command_row(session, "edit.delete");
    menu_line();
    command_row(session, "edit.hide");
    command_row(session, "edit.lock");
    command_row(session, "edit.show-all");
    menu_line();
    command_row(session, "edit.group");
    command_row(session, "edit.ungroup");
    menu_line();
    command_row(session, "key.add");
    if (const Thing* thing = replaceable(session)) {
      Value args;
      args.set("list", thing->list);
      args.set("replace", thing->name);
      command_row(session, "file.import", "Replace mesh…", args);
    }
  }
  end_menu();
}

}  // namespace focalstage
