#pragma once

#include "editor/cli/command.h"

namespace focalstage {

// One per file command_NAME.cpp; the table that names them is in command_list.cpp.
Command::Run declare_new(CLI::App& app);
Command::Run declare_check(CLI::App& app);
Command::Run declare_compile(CLI::App& app);
Command::Run declare_export(CLI::App& app);
Command::Run declare_retina(CLI::App& app);
Command::Run declare_push(CLI::App& app);
Command::Run declare_rig(CLI::App& app);
Command::Run declare_devices(CLI::App& app);
Command::Run declare_pair(CLI::App& app);
Command::Run declare_import(CLI::App& app);
Command::Run declare_process(CLI::App& app);
Command::Run declare_apply(CLI::App& app);
Command::Run declare_solve(CLI::App& app);
Command::Run declare_shape(CLI::App& app);
Command::Run declare_adopt_rig(CLI::App& app);
Command::Run declare_track_align(CLI::App& app);
Command::Run declare_calibrate(CLI::App& app);
Command::Run declare_trials(CLI::App& app);
Command::Run declare_runtime(CLI::App& app);
Command::Run declare_edit(CLI::App& app);
Command::Run declare_bench(CLI::App& app);

}  // namespace focalstage
