#include "editor/trials/scripted_seat.h"

#include <cstdio>
#include <thread>

#include "core/study/response.h"
#include "editor/trials/faults.h"

namespace focalstage {
namespace {

constexpr std::chrono::milliseconds between_tries{100};

}  // namespace

std::string ScriptedSeat::kind() const { return scripted_prefix + script_.name(); }

void ScriptedSeat::begin_block(const std::vector<TrialBlock>& plan, const TrialBlock& block) {
  std::printf("Block %d of %zu, answered by the scripted participant \"%s\".\n", block.number, plan.size(),
              script_.name().c_str());
  std::fflush(stdout);
}

void ScriptedSeat::notice(const std::string& what) {
  std::printf("%s\n", what.c_str());
  std::fflush(stdout);
}

Result<TrialChoice> ScriptedSeat::ready(const TrialInPlan&, const WhileWaiting&) {
  if (stop_.stop_requested()) return stopped();
  return TrialChoice::go_on;
}

Result<TrialAnswer> ScriptedSeat::answer(const TrialInPlan& at, const WhileWaiting&) {
  if (stop_.stop_requested()) return stopped();
  troubled_since_.reset();
  const auto answer_m = script_.answer(at.study, at.participant, at.block, at.trial);
  if (!answer_m) return TrialAnswer{TrialAnswer::Kind::gave_up, 0.0};
  return TrialAnswer{TrialAnswer::Kind::matched, *answer_m};
}

Result<TrialChoice> ScriptedSeat::trouble(const std::string& what) {
  if (!troubled_since_) {
    std::printf("%s\n", what.c_str());
    std::fflush(stdout);
    troubled_since_ = Clock::now();
  }
  if (Clock::now() - *troubled_since_ > patience_) {
    return Fault{"rig.trouble", "rig", "nobody put it right in time: " + what,
                 "see to the rig, then go on with --resume"};
  }
  std::this_thread::sleep_for(between_tries);
  if (stop_.stop_requested()) return stopped();
  return TrialChoice::go_on;
}

Result<std::optional<bool>> ScriptedSeat::question(const std::string&) { return std::optional(script_.says_yes()); }

}  // namespace focalstage
