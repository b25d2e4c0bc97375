#include <CLI/CLI.hpp>
#include <memory>

#include "editor/cli/command_list.h"
#include "editor/cli/edit_file.h"
#include "editor/cli/output.h"
#include "editor/cli/rig_link.h"
#include "io/json/json.h"
#include "io/protocol/adopt.h"

namespace focalstage {
namespace {

struct Options {
  std::string project;
  std::string output;
  std::string rig;
  bool dry_run = false;
};

ExitStatus run(const Options& options) {
  const auto loaded = load_project(options.project);
  if (!loaded) return report(loaded.fault());
  auto rig = connect_to_rig(options.rig);
  if (!rig) return report(rig.fault());
  const auto description = rig->describe(loaded->project.sweep.frequency_hz);
  if (!description) return report(description.fault());
  const std::vector<Edit> edits = adopt(loaded->project, *description);
  for (const Edit& edit : edits) std::printf("%s\n", write_json(value_from(edit), -1).c_str());
  if (options.dry_run) return ExitStatus::done;
  if (const auto saved = apply_and_save(*loaded, edits, options.output); !saved) return report(saved.fault());
  return ExitStatus::done;
}

}  // namespace

Command::Run declare_adopt_rig(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("PROJECT", options->project, "a NAME.focal, or the folder that holds it")->required()->type_name("");
  app.add_option("-o,--output", options->output, "where to save; the project itself by default")->type_name("OUT");
  app.add_flag("--dry-run", options->dry_run, "print the edits (as focalstage apply reads them) and save nothing");
  add_rig_option(app, options->rig);
  return [options] { return run(*options); };
}

}  // namespace focalstage
