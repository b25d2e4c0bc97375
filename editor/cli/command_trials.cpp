#include <CLI/CLI.hpp>
#include <memory>

#include "core/study/scripted.h"
#include "editor/cli/command_list.h"
#include "editor/cli/rig_link.h"
#include "editor/cli/trials_actions.h"

namespace focalstage {
namespace {

using Action = ExitStatus (*)(const TrialsOptions&);

std::string scripted_names() {
  std::string names;
  for (const std::string& name : ScriptedParticipant::names()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

void declare_run(CLI::App& app, TrialsOptions& options) {
  app.add_option("STUDY", options.study, "a study file, or the folder that holds study.json")
      ->required()
      ->type_name("");
  app.add_option("--participant", options.participant, "who answers, as the study lists them")
      ->required()
      ->type_name("ID");
  add_rig_option(app, options.rig);
  app.add_option("--out", options.out, "where answers are kept; \"answers\" beside the study by default")
      ->type_name("DIR");
  app.add_option("--interpupillary-mm", options.interpupillary_mm,
                 "between this participant's pupils, as measured; the project's by default")
      ->type_name("MM")
      ->check(CLI::Range(40.0, 80.0).name(""));
  app.add_flag("--resume", options.resume, "go on where this participant stopped");
  app.add_flag("--one-block", options.one_block, "end after the block under way, as for one day of the paper's two");
  app.add_option("--scripted", options.scripted, "rehearse with a script instead of a person: " + scripted_names())
      ->type_name("NAME");
}

void declare_report(CLI::App& app, TrialsOptions& options) {
  app.add_option("DIR", options.folder, "the folder of answers, or the study's")->required()->type_name("");
  app.add_option("-o,--output", options.out, "write Markdown here and the plot beside it")->type_name("REPORT.md");
  app.add_flag("--json", options.json, "print the figures as one JSON object");
}

void declare_plan(CLI::App& app, TrialsOptions& options) {
  app.add_option("STUDY", options.study, "a study file, or the folder that holds study.json")
      ->required()
      ->type_name("");
  app.add_option("--participant", options.participant, "whose plan")->required()->type_name("ID");
  app.add_flag("--json", options.json, "print it as one JSON object");
}

}  // namespace

Command::Run declare_trials(CLI::App& app) {
  const auto options = std::make_shared<TrialsOptions>();
  const auto action = std::make_shared<Action>(nullptr);
  const auto add = [&](const char* name, const char* help, Action run) {
    CLI::App* below = app.add_subcommand(name, help);
    below->callback([action, run] { *action = run; });
    return below;
  };
  add("new", "Make a study of depth matching to start from.", run_trials_new)
      ->add_option("DIR", options->folder, "the folder to make")
      ->required()
      ->type_name("");
  declare_plan(*add("plan", "Print what a participant will be shown, in order.", run_trials_plan), *options);
  declare_run(*add("run", "Run a participant's trials on a rig.", run_trials_run), *options);
  declare_report(*add("report", "Report regression, analysis of variance and answers.", run_trials_report), *options);
  app.require_subcommand(1);
  return [options, action] { return (*action)(*options); };
}

}  // namespace focalstage
