#pragma once

#include <string>
#include <vector>

#include "devices/roles/trigger_board.h"

namespace focalstage::uno {

/// The commands that give a table to the board, in order. "board.table": a time that the line cannot say; all else the
/// board checks itself.
Result<std::vector<std::string>> table_commands(const BoardTable& table);

/// The board's refusal of one of them: "board.table".
Fault table_fault(const std::string& command, unsigned code);

}  // namespace focalstage::uno
