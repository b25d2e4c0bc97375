#include "editor/cli/viewer_sitting.h"

#include <stdlib.h>
#include <unistd.h>

#include <cstdio>
#include <system_error>
#include <utility>

#include "core/base/number_words.h"
#include "editor/cli/edit_file.h"
#include "editor/cli/interrupt.h"
#include "editor/cli/output.h"
#include "editor/cli/progress.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

bool is_at_terminal() { return ::isatty(STDIN_FILENO) != 0 && ::isatty(STDERR_FILENO) != 0; }

Result<fs::path> scratch_folder() {
  std::error_code problem;
  std::string name = (fs::temp_directory_path(problem) / "focalstage-viewer-XXXXXX").string();
  if (problem || ::mkdtemp(name.data()) == nullptr) {
    return Fault{"file.unwritable", name, "no folder can be made there", "set TMPDIR to a place with room"};
  }
  return fs::path(name);
}

/// What a study says of how to go on, as a test of a viewer says it.
Fault in_our_words(Fault fault, const ViewerOptions& options) {
  const bool ended = fault.code == "trials.stopped" || fault.code == "trials.input-ended";
  if (!ended) return fault;
  fault.message = fault.code == "trials.stopped" ? "was stopped" : "ended before the last question";
  fault.remedy = options.answers.empty() ? "with --answers FILE a test can go on where it was"
                                         : "say the same again to go on: what was answered is kept";
  return fault;
}

}  // namespace

ViewerSitting::ViewerSitting(const ViewerOptions& options, LoadedProject loaded, Source source, fs::path folder,
                             std::stop_token stop)
    : options_(options),
      loaded_(std::move(loaded)),
      source_(std::move(source)),
      folder_(std::move(folder)),
      stop_(std::move(stop)) {}

ViewerSitting::~ViewerSitting() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

Result<std::unique_ptr<ViewerSitting>> ViewerSitting::begin(const ViewerOptions& options, std::stop_token stop) {
  auto loaded = load_project(options.project);
  if (!loaded) return loaded.fault();
  auto source = open_project(options.project);
  if (!source) return source.fault();
  auto folder = scratch_folder();
  if (!folder) return folder.fault();
  return std::unique_ptr<ViewerSitting>(
      new ViewerSitting(options, *std::move(loaded), *std::move(source), *std::move(folder), std::move(stop)));
}

FrameProgress ViewerSitting::bar_of(const std::string& title) const {
  const auto style = options_.json ? Progress::Style::quiet : Progress::Style::automatic;
  const auto bar = std::make_shared<Progress>(title, style);
  return [bar](int done, int of) {
    bar->update(done, of, "pattern");
    if (done == of) bar->clear();
  };
}

Status ViewerSitting::connect() {
  if (rig_) return {};
  rig_.emplace(options_.rig);
  return rig_->connect(false);
}

Result<EqualityEstimate> ViewerSitting::ask(const TwoChoiceTest& test, const Guide& guide,
                                            const SeenDifference& simulated, const std::string& suffix) {
  if (Status reached = connect(); !reached) return reached.fault();
  std::unique_ptr<Observer> observer;
  if (options_.scripted) {
    observer = std::make_unique<ScriptedObserver>(simulated, options_.scripted_noise, options_.seed);
  } else {
    observer = std::make_unique<KeyObserver>(STDIN_FILENO, stop_, guide.keys);
  }
  TwoChoiceRun run;
  run.questions = options_.questions;
  run.stop = stop_;
  std::optional<ChoiceLog> log;
  if (!options_.answers.empty()) {
    auto opened = ChoiceLog::open(options_.answers + suffix, test, observer->kind());
    if (!opened) return opened.fault();
    log = *std::move(opened);
    run.log = &*log;
  }
  const bool told = !options_.scripted && is_at_terminal();
  if (told) {
    std::fprintf(stderr, "%s\nGuess where you cannot tell. q gives up.\n", guide.text.c_str());
    run.progress = [](int answered, int of) { std::fprintf(stderr, "\r%d of %d ", answered + 1, of); };
  }
  const auto found = run_two_choice(*rig_, test, *observer, run);
  if (told) std::fprintf(stderr, "\n");
  if (!found) return in_our_words(found.fault(), options_);
  if (!*found) return Fault{"viewer.given-up", options_.project, "nothing was measured and nothing changed", ""};
  return **found;
}

Status ViewerSitting::save(const Edit& edit) const {
  if (options_.dry_run) return {};
  const auto saved = apply_and_save(loaded_, {edit}, options_.output);
  return saved ? Status() : saved.fault();
}

const char* eye_word(Side eye) { return eye == Side::left ? "left" : "right"; }

const char* observer_kind(const ViewerOptions& options) { return options.scripted ? "scripted" : "human"; }

Status check_found(const ViewerOptions& options, const std::string& what, bool inside, double value_mm,
                   double uncertainty_mm, const std::string& range) {
  if (options.despite_uncertainty) return {};
  if (!inside) {
    return Fault{"viewer.outside", what, "the answers close in on no value from " + range,
                 "do it again, or see that viewer, glasses and project belong together"};
  }
  if (uncertainty_mm <= options.limit_mm) return {};
  return Fault{"viewer.uncertain", what,
               "the value is " + fixed_text(value_mm, 1) + " mm, uncertain by " + fixed_text(uncertainty_mm, 2) +
                   " mm, more than " + fixed_text(options.limit_mm, 2),
               "ask more with --questions, or take it all the same with --despite-uncertainty"};
}

ExitStatus run_sitting(const ViewerOptions& options,
                       const std::function<Result<ExitStatus>(ViewerSitting& sitting)>& action) {
  Interrupt interrupt;
  const auto sitting = ViewerSitting::begin(options, interrupt.token());
  if (!sitting) return report(sitting.fault());
  const auto status = action(**sitting);
  if (status) return *status;
  const ExitStatus failed = report(status.fault());
  interrupt.end_if_asked();
  return failed;
}

}  // namespace focalstage
