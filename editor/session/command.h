#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/scene/value.h"

namespace focalstage {

class Session;

/// One thing a person can ask of the editor. Menus, keys, the palette, buttons and scripts all go through this table.
struct Command {
  std::string_view id;        ///< "edit.undo"
  std::string_view title;     ///< "Undo"
  std::string_view shortcut;  ///< "Ctrl+Z"; empty: none
  std::string_view help;      ///< one sentence, shown as the tooltip
  std::string_view icon;      ///< name in editor/window's table of icons; may be empty
  bool in_palette = true;     ///< false: needs arguments that only a script or a view gives
  /// Why it cannot be done now, as a person reads it; empty: it can.
  std::string (*unavailable)(const Session&);
  /// `args`: an object; each command documents its own in `help` or beside its definition. Faults say what was wrong.
  Status (*run)(Session&, const Value& args);
  /// Whether menus and the palette list it at all; none: always.
  bool (*shown)(const Session&) = nullptr;
};

/// All commands, in the order of the palette.
std::span<const Command> commands();

const Command* command_named(std::string_view id);

}  // namespace focalstage
