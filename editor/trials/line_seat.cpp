#include "editor/trials/line_seat.h"

#include <cstdio>

#include "core/study/response.h"
#include "editor/trials/trial_words.h"

namespace focalstage {
namespace {

void say(const std::string& text) {
  std::printf("%s\n", text.c_str());
  std::fflush(stdout);
}

}  // namespace

std::string LineSeat::kind() const { return human_kind; }

void LineSeat::begin_block(const std::vector<TrialBlock>& plan, const TrialBlock& block) {
  say(block_text(plan, block));
}

void LineSeat::notice(const std::string& what) { say(printable(what)); }

Result<TrialChoice> LineSeat::ready(const TrialInPlan&, const WhileWaiting&) { return TrialChoice::go_on; }

Result<TrialAnswer> LineSeat::answer(const TrialInPlan& at, const WhileWaiting& check) {
  say(trial_text(at) + ": mm, g to give up, q to pause");
  for (;;) {
    const auto line = input_.line(check);
    if (!line) return line.fault();
    if (*line == "g") return TrialAnswer{TrialAnswer::Kind::gave_up, 0.0};
    if (*line == "q") return TrialAnswer{TrialAnswer::Kind::pause, 0.0};
    const auto reading_m = reading_from(*line, at.study.pointer);
    if (reading_m) return TrialAnswer{TrialAnswer::Kind::matched, *reading_m};
    say(complaint(reading_m.fault()));
  }
}

Result<TrialChoice> LineSeat::trouble(const std::string& what) {
  say(what + " An empty line goes on and lets the rig be lit again, q pauses.");
  for (;;) {
    const auto line = input_.line({});
    if (!line) return line.fault();
    if (line->empty()) return TrialChoice::go_on;
    if (*line == "q") return TrialChoice::pause;
    say("An empty line, or q.");
  }
}

Result<std::optional<bool>> LineSeat::question(const std::string& text) {
  say(printable(text) + " (y or n, q to pause)");
  for (;;) {
    const auto line = input_.line({});
    if (!line) return line.fault();
    if (*line == "y" || *line == "yes") return std::optional(true);
    if (*line == "n" || *line == "no") return std::optional(false);
    if (*line == "q") return std::optional<bool>();
    say("y, n or q.");
  }
}

}  // namespace focalstage
