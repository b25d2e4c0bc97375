#include "editor/document/replay.h"

#include <algorithm>

namespace focalstage {

History replayed(const Project& base, const std::vector<JournalRecord>& records) {
  History history(base);
  for (const JournalRecord& record : records) {
    if (const auto* jump = std::get_if<JournalJump>(&record)) {
      history.jump(jump->place);
      continue;
    }
    const auto& made = std::get<JournalStep>(record);
    if (!history.apply(made.step, made.joining)) break;
  }
  return history;
}

std::vector<std::string> words_of(const std::vector<JournalRecord>& records) {
  std::vector<std::string> steps;
  std::size_t place = 0;
  for (const JournalRecord& record : records) {
    if (const auto* jump = std::get_if<JournalJump>(&record)) {
      place = std::min(jump->place, steps.size());
      continue;
    }
    const auto& made = std::get<JournalStep>(record);
    const bool goes_on = made.joining == Joining::continues_last && place > 0 && place == steps.size() &&
                         steps.back() == made.step.words;
    steps.resize(goes_on ? place - 1 : place);
    steps.push_back(made.step.words);
    place = steps.size();
  }
  steps.resize(place);
  return steps;
}

}  // namespace focalstage
