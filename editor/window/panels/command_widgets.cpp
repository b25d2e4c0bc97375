#include "editor/window/panels/command_widgets.h"

#include <cassert>

#include "editor/session/session.h"

namespace focalstage {
namespace {

const Command& known(std::string_view id) {
  const Command* command = command_named(id);
  assert(command != nullptr);
  return *command;
}

}  // namespace

CommandFace::CommandFace(const Session& session, std::string_view id)
    : command(known(id)), unavailable(command.unavailable(session)) {}

Tip CommandFace::tip() const { return {command.help, command.shortcut, unavailable}; }

bool command_button(Session& session, std::string_view id, std::string_view name, std::string_view label,
                    ButtonStyle style, const Value& args) {
  const CommandFace face(session, id);
  const std::string_view help = style.tip.help;
  style.tip = face.tip();
  if (!help.empty()) style.tip.help = help;
  if (style.icon.empty() && label.empty()) style.icon = face.command.icon;
  const bool pressed = named_button(name, label, style);
  if (pressed) (void)session.run(id, args);
  return pressed;
}

}  // namespace focalstage
