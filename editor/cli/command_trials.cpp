#include <unistd.h>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "core/study/scripted.h"
#include "editor/cli/command_list.h"
#include "editor/cli/interrupt.h"
#include "editor/cli/output.h"
#include "editor/cli/rig_link.h"
#include "editor/samples/samples.h"
#include "editor/trials/example_study.h"
#include "editor/trials/key_seat.h"
#include "editor/trials/line_seat.h"
#include "editor/trials/run_trials.h"
#include "editor/trials/scripted_seat.h"
#include "io/files/files.h"
#include "io/study/report.h"
#include "io/study/study_file.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

constexpr const char* answers_folder = "answers";
constexpr std::chrono::seconds scripted_patience{20};

struct Options {
  std::string folder;
  std::string study;
  std::string participant;
  std::string rig;
  std::string out;
  std::string scripted;
  double interpupillary_mm = 0.0;  ///< 0: the project's
  bool resume = false;
  bool one_block = false;
  bool json = false;
};

// new ---------------------------------------------------------------------------------------------------------------

Status make_new(const Options& options) {
  const fs::path folder = options.folder;
  std::error_code problem;
  if (fs::exists(folder, problem) && (!fs::is_directory(folder, problem) || !fs::is_empty(folder, problem))) {
    return Fault{"project.exists", folder.string(), "is there already and not empty", "choose another name"};
  }
  const auto sample = sample_named(example_project);
  if (!sample) return sample.fault();
  const auto made = write_sample(*sample, folder / example_project);
  if (!made) return made.fault();
  return write_file_atomically(folder / study_file_name, study_text(example_study()));
}

ExitStatus run_new(const Options& options) {
  if (const Status made = make_new(options); !made) return report(made.fault());
  std::printf("%s: a study to start from; docs/trials.md says what to change\n",
              (fs::path(options.folder) / study_file_name).lexically_normal().c_str());
  return ExitStatus::done;
}

// plan --------------------------------------------------------------------------------------------------------------

Value plan_value(const Study& study, const std::vector<Block>& plan) {
  Value::Array blocks;
  for (const Block& block : plan) {
    Value::Array trials;
    for (const Trial& trial : block.trials) {
      Value item;
      item.set("trial", trial.number);
      item.set("training", trial.training);
      item.set("target", study.targets[static_cast<std::size_t>(trial.target)].name);
      item.set("repetition", trial.repetition);
      item.set("pointer_start_m", trial.pointer_start_m);
      trials.push_back(std::move(item));
    }
    Value value;
    value.set("block", block.number);
    value.set("condition", study.conditions[static_cast<std::size_t>(block.condition)].name);
    value.set("trials", std::move(trials));
    blocks.push_back(std::move(value));
  }
  Value value;
  value.set("blocks", std::move(blocks));
  return value;
}

std::string plan_text(const Study& study, const std::vector<Block>& plan) {
  std::vector<std::vector<std::string>> rows;
  for (const Block& block : plan) {
    for (const Trial& trial : block.trials) {
      rows.push_back({std::to_string(block.number), study.conditions[static_cast<std::size_t>(block.condition)].name,
                      std::to_string(trial.number), trial.training ? "training" : std::to_string(trial.repetition),
                      study.targets[static_cast<std::size_t>(trial.target)].name,
                      number_text(trial.pointer_start_m * 1e3, 1)});
    }
  }
  return table_text(
      {{"block", true}, {"condition"}, {"trial", true}, {"repetition", true}, {"target"}, {"pointer mm", true}}, rows);
}

ExitStatus run_plan(const Options& options) {
  const auto loaded = load_study(options.study);
  if (!loaded) return report(loaded.fault());
  const auto index = participant_index(loaded->study, options.participant);
  if (!index) return report(index.fault());
  const std::vector<Block> plan = plan_of(loaded->study, *index);
  if (options.json) {
    print_json(plan_value(loaded->study, plan));
  } else {
    std::fputs(plan_text(loaded->study, plan).c_str(), stdout);
  }
  return ExitStatus::done;
}

// run ---------------------------------------------------------------------------------------------------------------

Result<std::unique_ptr<TrialParticipant>> seat_of(const Options& options, const std::stop_token& stop) {
  if (options.scripted.empty()) {
    if (::isatty(STDIN_FILENO) != 0 && ::isatty(STDOUT_FILENO) != 0) {
      return std::unique_ptr<TrialParticipant>(std::make_unique<KeySeat>(STDIN_FILENO, stop));
    }
    return std::unique_ptr<TrialParticipant>(std::make_unique<LineSeat>(STDIN_FILENO, stop));
  }
  auto script = ScriptedParticipant::named(options.scripted);
  if (!script) return script.fault();
  return std::unique_ptr<TrialParticipant>(std::make_unique<ScriptedSeat>(std::move(*script), scripted_patience, stop));
}

/// People's answers and scripted ones never share a folder, nor do two kinds one participant.
Status check_kind(const std::vector<Response>& there, const std::string& participant, const std::string& kind,
                  const fs::path& out) {
  for (const Response& response : there) {
    if (response.participant == participant && response.kind != kind) {
      return Fault{"study.mixed", out.string(), participant + " has answered as " + response.kind,
                   "go on as that, or choose another folder with --out"};
    }
    if (is_scripted(response.kind) != is_scripted(kind)) {
      return Fault{"study.mixed", out.string(), "holds answers of " + response.kind + " participants",
                   "choose another folder with --out: people and scripts are kept apart"};
    }
  }
  return {};
}

/// What must hold before anything is shown; the log is open then.
Result<AnswerLog> open_log(const Options& options, const Study& study, const fs::path& out, const std::string& kind) {
  auto log = AnswerLog::open(out, study, options.participant);
  if (!log) return log.fault();
  if (!log->responses().empty() && !options.resume) {
    return Fault{"trials.begun", out.string(), options.participant + " has begun already",
                 "go on with --resume, or choose another folder with --out"};
  }
  const auto all = load_answers(out);
  if (!all) return all.fault();
  if (Status same = check_kind(all->responses, options.participant, kind, out); !same) return same.fault();
  return log;
}

/// The distance between the participant's eyes: as given, or as it was before. Nothing: the project's.
Result<std::optional<double>> interpupillary_of(const Options& options, const AnswerLog& log) {
  std::optional<double> given;
  if (options.interpupillary_mm > 0.0) given = options.interpupillary_mm;
  if (log.responses().empty()) return given;
  const double before_mm = log.responses().back().interpupillary_mm;
  if (!given || *given == before_mm) return std::optional(before_mm);
  return Fault{"study.show-differs", "--interpupillary-mm " + short_number(*given),
               options.participant + " began with " + short_number(before_mm) + " mm",
               "leave the option out, or begin anew in another folder (--out)"};
}

Status check_all_shows(const Study& study, const std::vector<ReadyCondition>& conditions, const fs::path& out) {
  const auto all = load_answers(out);
  if (!all) return all.fault();
  return check_shows(study, conditions, all->responses);
}

void print_end(const Options& options, const SittingEnd& end, const fs::path& out) {
  const std::string file = (out / (options.participant + ".csv")).lexically_normal().string();
  std::printf("%s: %d of %d trials are in %s", options.participant.c_str(), end.progress.done, end.progress.of,
              file.c_str());
  if (end.spoiled > 0)
    std::printf("; %d did not count in this sitting and %s repeated", end.spoiled, end.spoiled == 1 ? "is" : "are");
  std::printf(end.progress.finished() && !end.paused ? "\n" : "; go on with --resume\n");
}

Result<SittingEnd> sit(const Options& options, const LoadedStudy& loaded, const fs::path& out,
                       const std::stop_token& stop) {
  const auto seat = seat_of(options, stop);
  if (!seat) return seat.fault();
  auto log = open_log(options, loaded.study, out, (*seat)->kind());
  if (!log) return log.fault();
  if (log->was_torn())
    std::fprintf(stderr, "focalstage: a row was being written when the power went; its trial is repeated\n");
  const auto interpupillary_mm = interpupillary_of(options, *log);
  if (!interpupillary_mm) return interpupillary_mm.fault();
  const fs::path shows = out / "shows" / options.participant;
  auto conditions = make_conditions(loaded.study, loaded.file.parent_path(), shows, *interpupillary_mm, stop);
  if (!conditions) return conditions.fault();
  if (Status same = check_all_shows(loaded.study, *conditions, out); !same) return same.fault();
  const Sitting sitting{loaded.study, options.participant, std::move(*conditions), options.one_block};
  ProtocolTrialRig rig(options.rig);
  return run_trials(sitting, *log, rig, **seat, stop);
}

ExitStatus run_run(const Options& options) {
  Interrupt interrupt;
  const auto loaded = load_study(options.study);
  if (!loaded) return report(loaded.fault());
  const fs::path out = options.out.empty() ? loaded->file.parent_path() / answers_folder : fs::path(options.out);
  const auto end = sit(options, *loaded, out, interrupt.token());
  if (!end) {
    const ExitStatus status = report(end.fault());
    interrupt.end_if_asked();
    return end.fault().code == "study.scripted" ? ExitStatus::usage : status;
  }
  print_end(options, *end, out);
  return ExitStatus::done;
}

// report ------------------------------------------------------------------------------------------------------------

/// The folder of answers: the one named, or the one that `run` made beside its study.
fs::path answers_in(const fs::path& folder) {
  std::error_code problem;
  return fs::is_directory(folder / answers_folder, problem) ? folder / answers_folder : folder;
}

Status write_report(const Report& made, const fs::path& file) {
  const fs::path plot = fs::path(file).replace_extension(".svg");
  if (plot == file) return Fault{"usage", file.string(), "is the picture's own name", "name a .md file"};
  if (Status written = write_file_atomically(plot, report_svg(made)); !written) return written;
  return write_file_atomically(file, report_markdown(made, plot.filename().string()));
}

ExitStatus run_report(const Options& options) {
  auto answers = load_answers(answers_in(options.folder));
  if (!answers) return report(answers.fault());
  const Report made = report_of(std::move(*answers));
  if (!options.out.empty()) {
    if (const Status written = write_report(made, options.out); !written) {
      const ExitStatus status = report(written.fault());
      return written.fault().code == "usage" ? ExitStatus::usage : status;
    }
  }
  if (options.json) {
    print_json(report_value(made));
  } else if (options.out.empty()) {
    std::fputs(report_markdown(made, "").c_str(), stdout);
  } else {
    std::printf("%s: %zu participants%s\n", options.out.c_str(), made.tallies.size(),
                made.scripted() ? ", scripted: no human result" : "");
  }
  return ExitStatus::done;
}

// -------------------------------------------------------------------------------------------------------------------

using Action = ExitStatus (*)(const Options&);

std::string scripted_names() {
  std::string names;
  for (const std::string& name : ScriptedParticipant::names()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

void declare_run(CLI::App& app, Options& options) {
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

void declare_report(CLI::App& app, Options& options) {
  app.add_option("DIR", options.folder, "the folder of answers, or the study's")->required()->type_name("");
  app.add_option("-o,--output", options.out, "write Markdown here and the plot beside it")->type_name("REPORT.md");
  app.add_flag("--json", options.json, "print the figures as one JSON object");
}

void declare_plan(CLI::App& app, Options& options) {
  app.add_option("STUDY", options.study, "a study file, or the folder that holds study.json")
      ->required()
      ->type_name("");
  app.add_option("--participant", options.participant, "whose plan")->required()->type_name("ID");
  app.add_flag("--json", options.json, "print it as one JSON object");
}

}  // namespace

Command::Run declare_trials(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  const auto action = std::make_shared<Action>(nullptr);
  const auto add = [&](const char* name, const char* help, Action run) {
    CLI::App* below = app.add_subcommand(name, help);
    below->callback([action, run] { *action = run; });
    return below;
  };
  add("new", "Make a study of depth matching to start from.", run_new)
      ->add_option("DIR", options->folder, "the folder to make")
      ->required()
      ->type_name("");
  declare_plan(*add("plan", "Print what a participant will be shown, in order.", run_plan), *options);
  declare_run(*add("run", "Run a participant's trials on a rig.", run_run), *options);
  declare_report(*add("report", "Report regression, analysis of variance and answers.", run_report), *options);
  app.require_subcommand(1);
  return [options, action] { return (*action)(*options); };
}

}  // namespace focalstage
