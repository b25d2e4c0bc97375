#include <unistd.h>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "core/base/number_words.h"
#include "core/study/scripted.h"
#include "editor/cli/interrupt.h"
#include "editor/cli/output.h"
#include "editor/cli/progress.h"
#include "editor/cli/trials_actions.h"
#include "editor/trials/key_seat.h"
#include "editor/trials/line_seat.h"
#include "editor/trials/run_trials.h"
#include "editor/trials/scripted_seat.h"
#include "io/study/study_file.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds scripted_patience{20};

Result<std::unique_ptr<TrialParticipant>> seat_of(const TrialsOptions& options, const std::stop_token& stop) {
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
Result<AnswerLog> open_log(const TrialsOptions& options, const Study& study, const fs::path& out,
                           const std::string& kind) {
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
Result<std::optional<double>> interpupillary_of(const TrialsOptions& options, const AnswerLog& log) {
  std::optional<double> given;
  if (options.interpupillary_mm > 0.0) given = options.interpupillary_mm;
  if (log.responses().empty()) return given;
  const double before_mm = log.responses().back().interpupillary_mm;
  if (!given || *given == before_mm) return std::optional(before_mm);
  return Fault{"study.show-differs", "--interpupillary-mm " + short_text(*given),
               options.participant + " began with " + short_text(before_mm) + " mm",
               "leave the option out, or begin anew in another folder (--out)"};
}

Status check_all_shows(const Study& study, const std::vector<ReadyCondition>& conditions, const fs::path& out) {
  const auto all = load_answers(out);
  if (!all) return all.fault();
  return check_shows(study, conditions, all->responses);
}

void print_end(const TrialsOptions& options, const SittingEnd& end, const fs::path& out) {
  const std::string file = (out / (options.participant + ".csv")).lexically_normal().string();
  std::printf("%s: %d of %d trials are in %s", options.participant.c_str(), end.progress.done, end.progress.of,
              file.c_str());
  if (end.spoiled > 0)
    std::printf("; %d did not count in this sitting and %s repeated", end.spoiled, end.spoiled == 1 ? "is" : "are");
  std::printf(end.progress.finished() && !end.paused ? "\n" : "; go on with --resume\n");
}

/// Says how far it has come, but not with which condition: who sits at the screen stays blind.
Result<std::vector<ReadyCondition>> make_shows(const LoadedStudy& loaded, const fs::path& shows,
                                               const std::optional<double>& interpupillary_mm,
                                               const std::stop_token& stop) {
  Progress bar("Preparing the shows", Progress::Style::automatic);
  const auto tell = [&](int done, int of) { bar.update(done, of, "frame"); };
  return make_conditions(loaded.study, loaded.file.parent_path(), shows, interpupillary_mm, tell, stop);
}

Result<SittingEnd> sit(const TrialsOptions& options, const LoadedStudy& loaded, const fs::path& out,
                       const std::stop_token& stop) {
  const auto seat = seat_of(options, stop);
  if (!seat) return seat.fault();
  auto log = open_log(options, loaded.study, out, (*seat)->kind());
  if (!log) return log.fault();
  if (log->was_torn())
    std::fprintf(stderr, "focalstage: a row was being written when the power went; its trial is repeated\n");
  const auto interpupillary_mm = interpupillary_of(options, *log);
  if (!interpupillary_mm) return interpupillary_mm.fault();
  auto conditions = make_shows(loaded, out / "shows" / options.participant, *interpupillary_mm, stop);
  if (!conditions) return conditions.fault();
  if (Status same = check_all_shows(loaded.study, *conditions, out); !same) return same.fault();
  const Sitting sitting{loaded.study, options.participant, std::move(*conditions), options.one_block};
  ProtocolTrialRig rig(options.rig);
  return run_trials(sitting, *log, rig, **seat, stop);
}

}  // namespace

ExitStatus run_trials_run(const TrialsOptions& options) {
  Interrupt interrupt;
  const auto loaded = load_study(options.study);
  if (!loaded) return report(loaded.fault());
  const fs::path out = options.out.empty() ? loaded->file.parent_path() / trials_answers_folder : fs::path(options.out);
  const auto end = sit(options, *loaded, out, interrupt.token());
  if (!end) {
    const ExitStatus status = report(end.fault());
    interrupt.end_if_asked();
    return end.fault().code == "study.scripted" ? ExitStatus::usage : status;
  }
  print_end(options, *end, out);
  return ExitStatus::done;
}

}  // namespace focalstage
