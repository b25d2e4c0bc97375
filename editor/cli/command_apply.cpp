#include <CLI/CLI.hpp>
#include <memory>

#include "editor/cli/command_list.h"
#include "editor/cli/edit_file.h"
#include "editor/cli/output.h"

namespace focalstage {
namespace {

struct Options {
  std::string project;
  std::string edits;
  std::string output;
};

ExitStatus run(const Options& options) {
  const auto loaded = load_project(options.project);
  if (!loaded) return report(loaded.fault());
  const auto edits = read_edits(options.edits);
  if (!edits) return report(edits.fault());
  const auto file = apply_and_save(*loaded, *edits, options.output);
  if (!file) return report(file.fault());
  std::printf("%s: %zu %s applied\n", file->c_str(), edits->size(), edits->size() == 1 ? "edit" : "edits");
  return ExitStatus::done;
}

}  // namespace

Command::Run declare_apply(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("PROJECT", options->project, "a NAME.focal, or the folder that holds it")->required()->type_name("");
  app.add_option("EDITS", options->edits, "the edits: one JSON object per line")->required()->type_name("");
  app.add_option("-o,--output", options->output, "where to save; the project itself by default")->type_name("OUT");
  return [options] { return run(*options); };
}

}  // namespace focalstage
