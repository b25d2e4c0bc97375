#include <CLI/CLI.hpp>
#include <memory>

#include "editor/cli/command_list.h"
#include "editor/cli/output.h"
#include "editor/cli/progress.h"
#include "editor/pipeline/compile_show.h"
#include "editor/pipeline/source.h"

namespace focalstage {
namespace {

struct Options {
  std::string file;
  bool json = false;
};

Result<std::vector<Finding>> findings_of(const Options& options) {
  const auto style = options.json ? Progress::Style::quiet : Progress::Style::automatic;
  if (!is_show(options.file)) {
    const auto source = open_project(options.file);
    if (!source) return source.fault();
    Progress bar("Checking " + source->project.name, style);
    return check_project(*source, {}, [&](int done, int of) { bar.update(done, of, "frame"); }, {});
  }
  const auto show = ShowReader::open(options.file);
  if (!show) return show.fault();
  const auto source = project_in(*show, options.file);
  if (!source) return source.fault();
  Progress bar("Checking " + source->project.name, style);
  return check_show(*source, *show, [&](int done, int of) { bar.update(done, of, "frame"); }, {});
}

ExitStatus run(const Options& options) {
  const auto findings = findings_of(options);
  if (!findings) return report(findings.fault());
  if (options.json) {
    print_json(findings_value(*findings));
  } else {
    std::fputs(findings_text(*findings).c_str(), stdout);
  }
  return status_of(*findings);
}

}  // namespace

Command::Run declare_check(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("FILE", options->file, "a project (NAME.focal or its folder) or a show (.h5)")
      ->required()
      ->type_name("");
  app.add_flag("--json", options->json, "print the findings as one JSON object");
  return [options] { return run(*options); };
}

}  // namespace focalstage
