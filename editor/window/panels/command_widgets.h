#pragma once

#include <string>
#include <string_view>

#include "core/scene/value.h"
#include "editor/window/base/button.h"

namespace focalstage {

class Session;
struct Command;

/// What a widget shows of a command of the table, with why it cannot be done now.
struct CommandFace {
  CommandFace(const Session& session, std::string_view id);

  bool enabled() const { return unavailable.empty(); }
  Tip tip() const;

  const Command& command;
  std::string unavailable;
};

/// A button that runs a command; `label` empty: its icon alone. Known by `name`.
bool command_button(Session& session, std::string_view id, std::string_view name, std::string_view label,
                    ButtonStyle style = {}, const Value& args = {});

}  // namespace focalstage
