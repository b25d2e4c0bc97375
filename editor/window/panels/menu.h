#pragma once

#include <string_view>

#include <glm/vec2.hpp>

#include "core/scene/value.h"
#include "editor/window/base/list_row.h"

namespace focalstage {

class Session;

/// A popup under what was drawn between `min` and `max`, `width_px` pixels wide, kept within the window. Opens when
/// `open`; true while it is, then `end_menu`.
bool begin_menu(const char* id, bool open, glm::vec2 min, glm::vec2 max, float width_px);
void end_menu();

/// A row of a menu; a press closes the menu.
bool menu_row(std::string_view name, std::string_view label, const ListRowStyle& style = {});

/// A row that runs a command, by its title unless `label` is given.
void command_row(Session& session, std::string_view id, std::string_view label = {}, const Value& args = {});

/// A row that opens a menu beside it while the hand is on it; true while open, then `end_submenu`.
bool begin_submenu(std::string_view label, std::string_view icon_name, float width_px);
void end_submenu();

/// A line between groups of rows.
void menu_line();

}  // namespace focalstage
