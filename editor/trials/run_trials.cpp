#include "editor/trials/run_trials.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>
#include <thread>

#include "editor/trials/faults.h"

namespace focalstage {
namespace {

using Clock = std::chrono::steady_clock;

// A lease lasts 10 s after its holder was last heard of.
constexpr std::chrono::seconds lease_ends_within{12};
constexpr std::chrono::milliseconds between_tries{200};

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Runs one sitting; keeps what its steps share.
class Run {
 public:
  Run(const Sitting& sitting, AnswerLog& log, TrialRig& rig, TrialParticipant& participant, std::stop_token stop,
      std::vector<TrialBlock> plan, TrialProgress progress)
      : sitting_(sitting),
        log_(log),
        rig_(rig),
        participant_(participant),
        stop_(std::move(stop)),
        plan_(std::move(plan)),
        progress_(progress),
        sitting_number_(progress.sittings + 1) {}

  Result<SittingEnd> go();

 private:
  Result<TrialChoice> block();
  Result<TrialChoice> set_up(std::optional<std::string> trouble = std::nullopt);
  Result<TrialChoice> mend(const Fault& fault, bool repeats);
  bool waits_for_lease(const Fault& fault);
  Result<TrialChoice> trial();
  Result<TrialChoice> lit_trial(const TrialInPlan& at);
  Status write(const TrialInPlan& at, const TrialAnswer& answer, const std::string& spoiled, Clock::time_point lit_at);
  Result<TrialChoice> questions();
  void advance();

  const TrialBlock& current() const { return plan_[progress_.block]; }
  const ReadyCondition& condition() const { return sitting_.conditions[static_cast<std::size_t>(current().condition)]; }

  const Sitting& sitting_;
  AnswerLog& log_;
  TrialRig& rig_;
  TrialParticipant& participant_;
  std::stop_token stop_;
  std::vector<TrialBlock> plan_;
  TrialProgress progress_;
  int sitting_number_;
  int spoiled_ = 0;
  bool was_ready_ = false;
  std::optional<Clock::time_point> held_since_;
  Clock::time_point block_began_{};
};

void Run::advance() {
  ++progress_.done;
  if (++progress_.trial < current().trials.size()) return;
  progress_.trial = 0;
  ++progress_.block;
}

/// A rig that says it is held may be held by this very study, killed a moment ago: its lease ends by itself.
bool Run::waits_for_lease(const Fault& fault) {
  if (fault.code != "rig.held" || was_ready_) return false;
  if (!held_since_) {
    held_since_ = Clock::now();
    participant_.notice("The rig is held: " + fault.message + ". Waiting for it.");
  }
  if (Clock::now() - *held_since_ > lease_ends_within) return false;
  std::this_thread::sleep_for(between_tries);
  return true;
}

/// Connects and prepares the block's show. Where the rig is in trouble, asks for help until it works; the first time,
/// only for a darkness that a person may end: a rig that is not there is nothing to wait for.
Result<TrialChoice> Run::set_up(std::optional<std::string> trouble) {
  for (;;) {
    if (trouble) {
      const auto choice = participant_.trouble(*trouble);
      if (!choice || *choice == TrialChoice::pause) return choice;
    }
    Status ready = rig_.connect(trouble && participant_.lifts_darkness());
    if (ready) ready = rig_.prepare(condition(), stop_);
    if (ready) {
      was_ready_ = true;
      return TrialChoice::go_on;
    }
    if (stop_.stop_requested()) return stopped();
    const Fault& fault = ready.fault();
    if (waits_for_lease(fault)) continue;
    const bool hopeless = !is_of_rig(fault) || fault.code == "rig.differs";
    const bool may_be_lit = fault.code == "rig.dark" && participant_.lifts_darkness();
    if (hopeless || (!was_ready_ && !may_be_lit)) return fault;
    trouble = "The rig is not ready: " + describe(fault) + ".";
  }
}

/// After a fault of the rig: says so, and sets up anew once somebody saw to it.
Result<TrialChoice> Run::mend(const Fault& fault, bool repeats) {
  if (!is_of_rig(fault)) return fault;
  if (progress_.finished()) return TrialChoice::go_on;
  std::string trouble = "The rig failed: " + describe(fault) + ".";
  if (repeats) trouble += " This trial does not count and will be repeated.";
  return set_up(std::move(trouble));
}

Status Run::write(const TrialInPlan& at, const TrialAnswer& answer, const std::string& spoiled,
                  Clock::time_point lit_at) {
  Response row = response_to(sitting_.study, at.block, at.trial);
  row.participant = sitting_.participant;
  row.kind = participant_.kind();
  row.gave_up = answer.kind == TrialAnswer::Kind::gave_up;
  row.response_m = answer.response_m;
  row.spoiled = spoiled;
  row.sitting = sitting_number_;
  row.started_s = std::chrono::duration<double>(lit_at - block_began_).count();
  row.duration_s = seconds_since(lit_at);
  row.show_sha256 = condition().sha256;
  row.interpupillary_mm = condition().interpupillary_mm;
  row.rig = rig_.kind();
  if (!spoiled.empty()) ++spoiled_;
  return log_.add(row);
}

/// From light to answer. A fault of the rig comes back as such once the trial is marked.
Result<TrialChoice> Run::lit_trial(const TrialInPlan& at) {
  const auto lit_at = Clock::now();
  Status shown = rig_.show(condition().targets[static_cast<std::size_t>(at.trial.target)]);
  Result<TrialAnswer> answer =
      shown ? participant_.answer(at, [&] { return rig_.check(); }) : Result<TrialAnswer>(shown.fault());
  // What happened since the last look: an answer counts only if its light was there to the end.
  if (answer && answer->kind != TrialAnswer::Kind::pause) {
    if (Status still = rig_.check(); !still) answer = still.fault();
  }
  if (!answer) {
    if (!is_of_rig(answer.fault())) return answer.fault();
    if (Status marked = write(at, {}, answer.fault().code, lit_at); !marked) return marked.fault();
    return answer.fault();
  }
  const bool pause = answer->kind == TrialAnswer::Kind::pause;
  if (Status written = write(at, *answer, pause ? "paused" : "", lit_at); !written) return written.fault();
  if (pause) return TrialChoice::pause;
  advance();
  return TrialChoice::go_on;
}

Result<TrialChoice> Run::trial() {
  const TrialBlock& block = current();
  const TrialInPlan at{sitting_.study, sitting_.participant, plan_, block, block.trials[progress_.trial]};
  const auto ready = participant_.ready(at, [&] { return rig_.check(); });
  if (!ready) return mend(ready.fault(), false);
  if (*ready == TrialChoice::pause) return TrialChoice::pause;
  const Result<TrialChoice> shown = lit_trial(at);
  if (!shown) return mend(shown.fault(), true);
  if (Status dark = rig_.dark(); !dark) return mend(dark.fault(), false);
  return shown;
}

Result<TrialChoice> Run::block() {
  const std::size_t number = progress_.block;
  const auto ready = set_up();
  if (!ready || *ready == TrialChoice::pause) return ready;
  participant_.begin_block(plan_, current());
  block_began_ = Clock::now();
  while (progress_.block == number) {
    const auto choice = trial();
    if (!choice || *choice == TrialChoice::pause) return choice;
  }
  return TrialChoice::go_on;
}

Result<TrialChoice> Run::questions() {
  std::set<int> answered;
  for (const QuestionAnswer& answer : log_.questions()) answered.insert(answer.question);
  for (int q = 0; q < static_cast<int>(sitting_.study.questions.size()); ++q) {
    if (answered.contains(q)) continue;
    const auto said = participant_.question(sitting_.study.questions[static_cast<std::size_t>(q)].text);
    if (!said) return said.fault();
    if (!*said) return TrialChoice::pause;
    const QuestionAnswer answer{sitting_.participant, participant_.kind(), q, **said};
    if (Status written = log_.add(answer); !written) return written.fault();
  }
  return TrialChoice::go_on;
}

Result<SittingEnd> Run::go() {
  Result<TrialChoice> choice = TrialChoice::go_on;
  while (choice && *choice == TrialChoice::go_on && !progress_.finished()) {
    choice = block();
    if (sitting_.one_block) break;
  }
  (void)rig_.dark();  // also after a fault; a rig that is away has no light of ours to end
  if (choice && *choice == TrialChoice::go_on && progress_.finished()) choice = questions();
  if (!choice) return choice.fault();
  return SittingEnd{progress_, spoiled_, *choice == TrialChoice::pause};
}

}  // namespace

Status check_shows(const Study& study, const std::vector<ReadyCondition>& conditions,
                   const std::vector<Response>& responses) {
  for (const Response& response : responses) {
    const ReadyCondition& condition = conditions[static_cast<std::size_t>(response.condition)];
    if (response.show_sha256 == condition.sha256 || response.interpupillary_mm != condition.interpupillary_mm) continue;
    const std::string& name = study.conditions[static_cast<std::size_t>(response.condition)].name;
    return Fault{"study.show-differs", condition.show.string(),
                 "condition \"" + name + "\" is not what " + response.participant + " saw: its show has changed",
                 "bring the project back as it was, or begin anew in another folder (--out)"};
  }
  return {};
}

Result<SittingEnd> run_trials(const Sitting& sitting, AnswerLog& log, TrialRig& rig, TrialParticipant& participant,
                              const std::stop_token& stop) {
  const auto index = participant_index(sitting.study, sitting.participant);
  if (!index) return index.fault();
  std::vector<TrialBlock> plan = plan_of(sitting.study, *index);
  const auto progress = progress_of(sitting.study, plan, log.responses());
  if (!progress) return progress.fault();
  if (Status same = check_shows(sitting.study, sitting.conditions, log.responses()); !same) return same.fault();
  return Run(sitting, log, rig, participant, stop, std::move(plan), *progress).go();
}

}  // namespace focalstage
