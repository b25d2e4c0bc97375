#pragma once

#include <string>
#include <vector>

#include "editor/session/command.h"
#include "editor/session/session_state.h"

namespace focalstage {

using CommandList = std::vector<Command>;

// The table by what commands act on, in the order of the palette; each file of commands_*.cpp is one of them.
void add_file_commands(CommandList& list);
void add_export_commands(CommandList& list);
void add_edit_commands(CommandList& list);
void add_things_commands(CommandList& list);
void add_place_commands(CommandList& list);
void add_time_commands(CommandList& list);
void add_sweep_commands(CommandList& list);
void add_view_commands(CommandList& list);
void add_steer_commands(CommandList& list);
void add_eye_commands(CommandList& list);
void add_rig_commands(CommandList& list);
void add_finding_commands(CommandList& list);
void add_solve_commands(CommandList& list);

// Why a command cannot be done, as most of them put it.
std::string always(const Session& session);
std::string needs_project(const Session& session);
std::string needs_selection(const Session& session);
std::string needs_things(const Session& session);  ///< surfaces or objects among the selection

// Arguments -----------------------------------------------------------------------------------------------------------

/// The argument `key`, or a Fault "command.argument" that names it.
Result<std::string> text_arg(const Value& args, std::string_view key);
Result<double> number_arg(const Value& args, std::string_view key);
std::string text_or(const Value& args, std::string_view key, std::string otherwise);
double number_or(const Value& args, std::string_view key, double otherwise);
bool flag_or(const Value& args, std::string_view key, bool otherwise);

/// "Move rabbit", "Move 3 things"
std::string words_for(const std::string& verb, const std::vector<Thing>& things);

/// The surfaces and objects among the selection, those that are locked left out.
std::vector<Thing> unlocked(const Session::State& state);

}  // namespace focalstage
