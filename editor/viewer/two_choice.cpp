#include "editor/viewer/two_choice.h"

#include <charconv>

#include "io/files/files.h"

namespace focalstage {
namespace {

Fault bad_answers(const std::filesystem::path& path, std::size_t row, const std::string& message) {
  return {"viewer.answers", path.string() + ": line " + std::to_string(row + 2), message,
          "name another file with --answers, or put this one back as it was written"};
}

/// "12,above" or "12,below".
std::optional<ChoiceLog::Row> row_from(const std::string& line, std::size_t levels) {
  ChoiceLog::Row row;
  const char* end = line.data() + line.size();
  const auto [rest, error] = std::from_chars(line.data(), end, row.level);
  if (error != std::errc() || row.level >= levels) return std::nullopt;
  const std::string_view word(rest, static_cast<std::size_t>(end - rest));
  row.above = word == ",above";
  if (!row.above && word != ",below") return std::nullopt;
  return row;
}

/// Puts earlier answers to the questions they were given to.
Status replay(const ChoiceLog& log, int questions, EqualitySearch& search) {
  for (std::size_t i = 0; i < log.rows().size() && static_cast<int>(i) < questions; ++i) {
    const ChoiceLog::Row& row = log.rows()[i];
    if (row.level != search.next()) return bad_answers(log.path(), i, "is the answer to another question");
    search.take(row.level, row.above);
  }
  return {};
}

Result<std::optional<EqualityEstimate>> ask(TrialRig& rig, const TwoChoiceTest& test, Observer& observer,
                                            const TwoChoiceRun& run) {
  EqualitySearch search(test.levels);
  if (run.log) {
    if (Status known = replay(*run.log, run.questions, search); !known) return known.fault();
  }
  std::optional<std::size_t> prepared;
  for (int i = search.estimate().answers; i < run.questions; ++i) {
    run.progress(i, run.questions);
    const std::size_t level = search.next();
    const Stimulus& stimulus = test.stimuli[level];
    if (prepared != stimulus.show) {
      if (Status ready = rig.prepare(test.shows[stimulus.show], run.stop); !ready) return ready.fault();
      prepared = stimulus.show;
    }
    if (Status shown = rig.show(stimulus.target); !shown) return shown.fault();
    const auto choice = observer.choose(i, level, [&] { return rig.check(); });
    if (!choice) return choice.fault();
    if (*choice == Choice::give_up) return std::optional<EqualityEstimate>();
    const bool above = *choice == test.above;
    if (run.log) {
      if (Status kept = run.log->add({level, above}); !kept) return kept.fault();
    }
    search.take(level, above);
    // In the dark between two patterns nobody sees one change into the next.
    if (Status dark = rig.dark(); !dark) return dark.fault();
  }
  return std::optional(search.estimate());
}

}  // namespace

Result<ChoiceLog> ChoiceLog::open(const std::filesystem::path& path, const TwoChoiceTest& test,
                                  const std::string& kind) {
  std::string shows;
  for (const ReadyCondition& show : test.shows) shows += show.sha256;
  auto file = RowFile::open(path, "level,answer to " + sha256_hex(shows).substr(0, 16) + " by " + kind);
  if (!file) {
    if (file.fault().code != "study.rows") return file.fault();
    return Fault{"viewer.answers", path.string(), "holds the answers to another test",
                 "name another file with --answers"};
  }
  ChoiceLog log(path, std::move(*file));
  for (const std::string& line : log.file_.rows().lines) {
    const auto row = row_from(line, test.levels.size());
    if (!row) return bad_answers(path, log.rows_.size(), "is no answer");
    log.rows_.push_back(*row);
  }
  return log;
}

Status ChoiceLog::add(const Row& row) {
  if (Status kept = file_.append(std::to_string(row.level) + (row.above ? ",above" : ",below")); !kept) return kept;
  rows_.push_back(row);
  return {};
}

Result<std::optional<EqualityEstimate>> run_two_choice(TrialRig& rig, const TwoChoiceTest& test, Observer& observer,
                                                       const TwoChoiceRun& run) {
  auto found = ask(rig, test, observer, run);
  const Status dark = rig.dark();
  if (found && !dark) return dark.fault();
  return found;
}

}  // namespace focalstage
